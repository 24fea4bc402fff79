# For a survey that includes this after survey.mk: from $(OUT)/model.nc and shot.cfg to two shots, with slip and
# without, their difference, its spectrum, and a summary. SPECTRUM holds options of sw-spectrum.

SPECTRUM =
SHOOT = $(BIN)/sw-shoot $(OUT)/model.nc --config shot.cfg --threads $(THREADS)

all: summary $(OUT)/spectrum.nc $(OUT)/spectrum.txt $(OUT)/fractured.nc $(OUT)/elastic.nc## everything, then a summary

$(OUT)/fractured.sgy $(OUT)/fractured.nc &: $(OUT)/model.nc shot.cfg $(BIN)/sw-shoot## the shot, the fractures slipping
	$(SHOOT) --snapshots $(OUT)/fractured.nc -o $(OUT)/fractured.sgy

$(OUT)/elastic.sgy $(OUT)/elastic.nc &: $(OUT)/model.nc shot.cfg $(BIN)/sw-shoot## the same shot, nothing slipping
	$(SHOOT) --without slip --snapshots $(OUT)/elastic.nc -o $(OUT)/elastic.sgy

$(OUT)/response.sgy: $(OUT)/fractured.sgy $(OUT)/elastic.sgy $(BIN)/sw-diff## their difference: what the fractures send back
	$(BIN)/sw-diff $(OUT)/fractured.sgy $(OUT)/elastic.sgy -o $@

$(OUT)/spectrum.nc: $(OUT)/response.sgy $(BIN)/sw-spectrum## its spectrum, a mean over the receivers
	$(BIN)/sw-spectrum $< $(SPECTRUM) -o $@

$(OUT)/spectrum.txt: $(OUT)/response.sgy $(BIN)/sw-spectrum## the same as columns of numbers
	$(BIN)/sw-spectrum $< $(SPECTRUM) --text -o $@

$(OUT)/comparison.txt: $(OUT)/fractured.sgy $(OUT)/elastic.sgy $(BIN)/sw-compare## how far the two shots are apart
	$(BIN)/sw-compare $(OUT)/fractured.sgy $(OUT)/elastic.sgy -o $@

.PHONY: summary
summary: $(OUT)/model.nc $(OUT)/response.sgy $(OUT)/comparison.txt $(BIN)/sw-info## what came out
	@$(BIN)/sw-info $(OUT)/model.nc $(OUT)/response.sgy
	@echo 'fractured against elastic shot:'
	@sed -n '1p;/^ *all/p' $(OUT)/comparison.txt
