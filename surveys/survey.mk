# The base of every survey: `include ../survey.mk`, then rules from models to gathers and spectra.
#   make            everything the survey makes, in $(OUT)
#   make -n         the commands that this would run
#   make help       targets (rules with a `##` comment) and settings
#   make clean      removes $(OUT)
# Make can trust every file it finds: the tools write whole files or none, and what a failed command left is deleted.

SURVEYS := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
BUILD = $(SURVEYS)/../build/release# where the tools are built
BIN = $(abspath $(BUILD))/bin# where they stand
OUT = out# where the results go
THREADS = $(shell nproc)# threads of one simulation

MAKEFLAGS += --no-builtin-rules
.SUFFIXES:
.DELETE_ON_ERROR:
.DEFAULT_GOAL := all
.PHONY: all clean help

TOOLS := $(patsubst $(SURVEYS)/../tools/sw_%.cpp,$(BIN)/sw-%,$(wildcard $(SURVEYS)/../tools/sw_*.cpp))

# Tools that are not there are built; those that are there are left as they are.
$(TOOLS) &:
	SLIPWAVE_BUILD='$(abspath $(BUILD))' '$(SURVEYS)/run' --build

$(OUT):
	mkdir -p '$@'

clean:## removes the results
	rm -rf '$(OUT)'

# A rule's comment, with the names that it makes and $(OUT) put in.
help:
	@echo 'make TARGET [SETTING=VALUE]; targets:'
	@cat $(MAKEFILE_LIST) | sed -n 's|$$(OUT)|$(OUT)|g; s|^\([^#:	][^:]*[^:& ]\) *&*:.*##|\1\t|p' | \
	  awk -F '\t *' '{ printf "  %-38s %s\n", $$1, $$2 }'
	@echo 'settings:'
	@echo '  OUT=$(OUT)  THREADS=$(THREADS)  BUILD=$(abspath $(BUILD))'
