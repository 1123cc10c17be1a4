# Records that lie elsewhere: DATA=dir names their folder. The channels that are used are copied under results/; nothing of them is kept
# here.
CAMPAIGN := $(RESULTS)/campaign

INPUTS_s3_identification += $(CAMPAIGN)/campaign.toml

$(CAMPAIGN)/campaign.toml: $(WORKFLOW)/campaign.py $(if $(DATA),$(call FILES,$(DATA)/channels.csv $(DATA)/*.npy))
	@$(if $(DATA),,$(if $(wildcard $(CAMPAIGN)/campaign.toml),,echo "$(STUDY): give the folder of the records, make s3 STUDY=$(STUDY) DATA=dir" >&2; exit 2))
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/campaign.py '$(DATA)' $(CAMPAIGN)

# The transverse mode of each earthquake and a model of it; the model fitted to the weak ones, where the strong ones are held out all three;
# then the diagnosis, which starts from that model and keeps the strongest from the fit.
INPUTS := $(RESULTS)/inputs
WEAK_FIT := $(RESULTS)/weak_fit
STRONG := nov1987_237 oct1979_484 dec2009_498
comma := ,

INPUTS_s9_diagnosis += $(WEAK_FIT)/manifest.json $(call FILES,$(WORKFLOW)/hypotheses/*)

$(INPUTS)/model/model.toml: $(RESULTS)/s3_identification/manifest.json $(WORKFLOW)/make_model.py
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/make_model.py $(CAMPAIGN) $(RESULTS)/s3_identification/features $(INPUTS)

$(WEAK_FIT)/manifest.json: $(INPUTS)/model/model.toml $(WORKFLOW)/s9_diagnosis.toml $(PRODUCT)workflows/common/narrow.py $(BIN)/s9_diagnosis
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(WEAK_FIT) --model $(INPUTS)/model --threads $(THREADS) --quiet \
	  --set most_causes=0 --set 'hold_out=[$(subst $() ,$(comma),$(STRONG:%="%"))]'
	@$(PRODUCT)workflows/python.sh $(PRODUCT)workflows/common/narrow.py $(WEAK_FIT)/extended_model $(INPUTS)/fitted_model

# make windows: the strong earthquakes in two parts, each identified by itself (25 Hz, fewer block rows: the shortest part is 10 s); the weak ones and the strong
# parts of 1987 and 2009 are fitted, the strong part of 1979 and what followed in all three held out.
.PHONY: windows
windows: $(RESULTS)/s9_diagnosis/manifest.json
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/windows.py $(CAMPAIGN) $(RESULTS)/windows/campaign
	@$(BIN)/s3_identification --study $(WORKFLOW) --campaign $(RESULTS)/windows/campaign --out $(RESULTS)/windows/s3_identification \
	  --threads $(THREADS) --set decimation=2 --set block_rows=6 --set maximum_order=14 --set welch_segment=32
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/make_model.py $(RESULTS)/windows/campaign $(RESULTS)/windows/s3_identification/features $(RESULTS)/windows/inputs
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(RESULTS)/windows/s9_diagnosis --model $(INPUTS)/fitted_model \
	  --features $(RESULTS)/windows/inputs/features --threads $(THREADS) \
	  --set 'hold_out=["oct1979_484_strong"$(foreach event,$(STRONG),$(comma)"$(event)_after")]'
