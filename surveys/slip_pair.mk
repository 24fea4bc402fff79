# SPDX-License-Identifier: BSD-3-Clause
# For a survey that includes this after survey.mk: from $(OUT)/model.nc and shot.cfg to two shots, with slip and
# without, their difference, spectra, pictures, and a summary. The survey may set
SHOT =# options of sw-shoot beside those of shot.cfg
SPECTRUM =# options of sw-spectrum
COMPONENT = vz# what the pictures of traces and waves show
WAVE_TIME = 1# the time of the waves' pictures, s
MODEL_LOOK =# options of sw-plot for the model,
WAVE_LOOK =# for the waves over it,
WAVE_RESPONSE_LOOK = $(WAVE_LOOK)# for the response in them,
GATHER_LOOK =# for the traces,
RESPONSE_LOOK = $(GATHER_LOOK)# for those of the response

SHOOT = $(BIN)/sw-shoot $(OUT)/model.nc --config shot.cfg $(SHOT) --threads $(THREADS)
PAIR_PICTURES = $(foreach name,model wave wave-response traces traces-response spectrum,$(OUT)/$(name).png)
TASKS = $(OUT)/fractured.sgy $(OUT)/elastic.sgy
TASKS_NEED = $(OUT)/model.nc

all: summary $(OUT)/spectrum.txt $(PAIR_PICTURES)## everything, then a summary

$(OUT)/fractured.sgy $(OUT)/fractured.nc &: $(OUT)/model.nc shot.cfg $(BIN)/sw-shoot## the shot with slip
	$(SHOOT) --snapshots $(OUT)/fractured.nc -o $(OUT)/fractured.sgy

$(OUT)/elastic.sgy $(OUT)/elastic.nc &: $(OUT)/model.nc shot.cfg $(BIN)/sw-shoot## the same shot without slip
	$(SHOOT) --without slip --snapshots $(OUT)/elastic.nc -o $(OUT)/elastic.sgy

$(OUT)/response.sgy: $(OUT)/fractured.sgy $(OUT)/elastic.sgy $(BIN)/sw-diff## their difference: the response of the fractures
	$(BIN)/sw-diff $(OUT)/fractured.sgy $(OUT)/elastic.sgy -o $@

$(OUT)/spectrum.nc: $(OUT)/response.sgy $(BIN)/sw-spectrum## mean spectrum of the response over the receivers
	$(BIN)/sw-spectrum $< $(SPECTRUM) -o $@

$(OUT)/spectrum.txt: $(OUT)/response.sgy $(BIN)/sw-spectrum## the same as columns of numbers
	$(BIN)/sw-spectrum $< $(SPECTRUM) --text -o $@

$(OUT)/comparison.txt: $(OUT)/fractured.sgy $(OUT)/elastic.sgy $(BIN)/sw-compare## the difference of the two shots in numbers
	$(BIN)/sw-compare $(OUT)/fractured.sgy $(OUT)/elastic.sgy -o $@

$(OUT)/model.png: $(OUT)/model.nc $(OUT)/fractured.sgy $(BIN)/sw-plot## the model, its fractures, source and receivers
	$(PLOT) $< --survey $(OUT)/fractured.sgy $(MODEL_LOOK) -o $@

$(OUT)/wave.png: $(OUT)/fractured.nc $(OUT)/model.nc $(BIN)/sw-plot## the wave field at WAVE_TIME, over the model
	$(PLOT) $< --field $(COMPONENT) --time $(WAVE_TIME) --over $(OUT)/model.nc $(WAVE_LOOK) -o $@

$(OUT)/wave-response.png: $(OUT)/fractured.nc $(OUT)/elastic.nc $(OUT)/model.nc $(BIN)/sw-plot## the response in it
	$(PLOT) $< --minus $(OUT)/elastic.nc --field $(COMPONENT) --time $(WAVE_TIME) --over $(OUT)/model.nc $(WAVE_RESPONSE_LOOK) -o $@

$(OUT)/traces.png: $(OUT)/fractured.sgy $(BIN)/sw-plot## the traces
	$(PLOT) -q $< --component $(COMPONENT) $(GATHER_LOOK) -o $@

$(OUT)/traces-response.png: $(OUT)/response.sgy $(BIN)/sw-plot## the response in them
	$(PLOT) -q $< --component $(COMPONENT) $(RESPONSE_LOOK) -o $@

$(OUT)/spectrum.png: $(OUT)/spectrum.nc $(BIN)/sw-plot## its spectrum
	$(PLOT) $< -o $@

.PHONY: movie
movie: $(OUT)/fractured.nc $(OUT)/model.nc $(BIN)/sw-plot | $(OUT)## the wave field at all times, one picture each
	mkdir -p '$(OUT)/film'
	$(PLOT) $< --field $(COMPONENT) --over $(OUT)/model.nc $(WAVE_LOOK) --movie -o '$(OUT)/film/wave.png'

.PHONY: summary
summary: $(OUT)/model.nc $(OUT)/response.sgy $(OUT)/comparison.txt $(BIN)/sw-info## summary of the results
	@$(BIN)/sw-info $(OUT)/model.nc $(OUT)/response.sgy
	@echo 'fractured against elastic shot:'
	@sed -n '1p;/^ *all/p' $(OUT)/comparison.txt
