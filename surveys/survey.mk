# SPDX-License-Identifier: BSD-3-Clause
# The base of every survey: `include ../survey.mk`, then rules from models to gathers and pictures.
#   make            everything the survey makes, in $(OUT)
#   make -j N       N simulations at once, each of one thread
#   make -n         the commands that this would run
#   make slurm      writes an array job for the same targets
#   make help       targets (rules with a `##` comment) and settings
#   make clean      removes $(OUT)
# Make can trust every file it finds: the tools write whole files or none, and what a failed command left is deleted.

SURVEYS := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ifneq ($(wildcard $(SURVEYS)/run),)
BUILD = $(SURVEYS)/../build/release# where the tools are built
BIN = $(abspath $(BUILD))/bin# where they are
TOOLS := $(patsubst $(SURVEYS)/../tools/sw_%.cpp,$(BIN)/sw-%,$(wildcard $(SURVEYS)/../tools/sw_*.cpp))
else # installed, as PREFIX/share/slipwave/surveys
BUILD = $(abspath $(SURVEYS)/../../..)
BIN = $(BUILD)/bin
TOOLS :=
endif
OUT = out# where the results go
THREADS = $(if $(filter -j%,$(MAKEFLAGS)),1,$(shell nproc))# threads of one simulation
PLOT = $(BIN)/sw-plot# with options for all pictures, --dpi 300

MAKEFLAGS += --no-builtin-rules
.SUFFIXES:
.DELETE_ON_ERROR:
.DEFAULT_GOAL := all
.PHONY: all clean help slurm

ifneq ($(TOOLS),)
# Tools that are not there are built; those that are there are left as they are.
$(TOOLS) &:
	SLIPWAVE_BUILD='$(abspath $(BUILD))' '$(SURVEYS)/run' --build
endif

$(OUT):
	mkdir -p '$@'

# Names of settings that the model depends on. Its rule names $(OUT)/settings: other values make everything again.
SETTINGS =
values = $(strip $(foreach name,$(SETTINGS),$(name)=$($(name))))
.PHONY: FORCE
.SECONDEXPANSION:
$(OUT)/settings: $$(if $$(subst x$$(values),,x$$(file <$(OUT)/settings)),FORCE) | $(OUT)
	@echo '$(values)' > '$@'

clean:## removes the results
	rm -rf '$(OUT)'

# The array job: a task for each of $(TASKS), files that need nothing of each other once those of $(TASKS_NEED) are there.
# Task 0 makes all the rest.
TASKS =
TASKS_NEED =
CPUS = 1# processors of a task
SLURM = $(OUT)/$(notdir $(CURDIR)).slurm
slurm: $(TASKS_NEED) $(TOOLS) | $(OUT)## an array job for a cluster, a task for each simulation
	@$(if $(TASKS),,echo 'this survey is no set of tasks' >&2; exit 2)
	@{ echo '#!/bin/sh'; \
	  echo '#SBATCH --job-name=$(notdir $(CURDIR))'; \
	  echo '#SBATCH --array=1-$(words $(TASKS))'; \
	  echo '#SBATCH --cpus-per-task=$(CPUS)'; \
	  echo '#SBATCH --output=$(abspath $(OUT))/slurm-%A-%a.log'; \
	  echo '# Made by "make slurm". Task 0 makes what the others are for:'; \
	  echo '#   sbatch --array=0 --dependency=afterok:$$(sbatch --parsable $(notdir $(SLURM))) $(notdir $(SLURM))'; \
	  echo '# A task that failed or was cut off is made again when the job is submitted again; what is there is kept.'; \
	  echo 'set -eu'; \
	  echo 'case $${SLURM_ARRAY_TASK_ID:?} in'; \
	  echo '  0) target=all ;;'; \
	  n=0; for task in $(TASKS); do n=$$((n + 1)); echo "  $$n) target=$$task ;;"; done; \
	  echo '  *) echo "there is no task $$SLURM_ARRAY_TASK_ID" >&2; exit 2 ;;'; \
	  echo 'esac'; \
	  printf '%s ' 'exec make --no-print-directory -C "$(CURDIR)" "BUILD=$(abspath $(BUILD))"' \
	    '$(filter-out THREADS=% SLURM=% BUILD=%,$(MAKEOVERRIDES))'; \
	  echo '"THREADS=$${SLURM_CPUS_PER_TASK:-1}" "$$target"'; } > '$(SLURM)'
	@echo '$(SLURM): $(words $(TASKS)) tasks; submit with'
	@sed -n 's|^#   sbatch|  sbatch|p' $(SLURM)

# A rule's comment, with the names that it makes and $(OUT) put in; a setting's comment, with its value.
help:
	@echo 'make TARGET [SETTING=VALUE]; targets:'
	@cat $(MAKEFILE_LIST) | sed -n 's|$$(OUT)|$(OUT)|g; s|^\([^#:	][^:]*[^:& ]\) *&*:.*##|\1\t|p' | \
	  awk -F '\t *' '{ printf "  %-38s %s\n", $$1, $$2 }'
	@echo 'settings:'
	@$(foreach name,$(shell sed -n 's/^\([A-Z_]*\) = *[^#]*#[^#].*/\1/p' $(MAKEFILE_LIST) | awk '!seen[$$0]++'), \
	  printf '  %-38s %s\n' '$(name)=$($(name))' "$$(sed -n 's/^$(name) = *[^#]*# *//p' $(MAKEFILE_LIST) | head -n 1)";)
