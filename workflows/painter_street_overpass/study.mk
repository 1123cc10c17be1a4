# Records that lie elsewhere: DATA=dir names their folder. The channels that are used are copied under results/; nothing of them is kept
# here.
CAMPAIGN := $(RESULTS)/campaign

INPUTS_s3_identification += $(CAMPAIGN)/campaign.toml

$(CAMPAIGN)/campaign.toml: $(WORKFLOW)/campaign.py $(if $(DATA),$(call FILES,$(DATA)/channels.csv $(DATA)/*.npy))
	@$(if $(DATA),,$(if $(wildcard $(CAMPAIGN)/campaign.toml),,echo "$(STUDY): give the folder of the records, make s3 STUDY=$(STUDY) DATA=dir" >&2; exit 2))
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/campaign.py '$(DATA)' $(CAMPAIGN)

# The transverse mode of each part and a model of it; the model fitted to the weak parts (below 0.3 mm), the parts of December 2022 held out; then the
# diagnosis, which starts from that model, and beside it the same with every mode left out in turn.
INPUTS := $(RESULTS)/inputs
WEAK_FIT := $(RESULTS)/weak_fit
BESIDE := $(RESULTS)/mode_by_mode

INPUTS_s9_diagnosis += $(WEAK_FIT)/manifest.json $(BESIDE:%=%/manifest.json) $(call FILES,workflows/meloland_overpass/hypotheses/*)

$(INPUTS)/model/model.toml: $(RESULTS)/s3_identification/manifest.json $(WORKFLOW)/make_model.py
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/make_model.py $(CAMPAIGN) $(RESULTS)/s3_identification/features $(INPUTS)

$(WEAK_FIT)/manifest.json: $(INPUTS)/model/model.toml $(WORKFLOW)/s9_diagnosis.toml $(PRODUCT)workflows/common/narrow.py $(BIN)/s9_diagnosis
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(WEAK_FIT) --model $(INPUTS)/model --threads $(THREADS) --quiet \
	  --set most_causes=0 --set 'hold_out=["dec2022_603_strong","dec2022_603_after"]'
	@$(PRODUCT)workflows/python.sh $(PRODUCT)workflows/common/narrow.py $(WEAK_FIT)/extended_model $(INPUTS)/fitted_model

$(RESULTS)/mode_by_mode/manifest.json: OTHER := --set 'hold_out=[]'
$(BESIDE:%=%/manifest.json): %/manifest.json: $(WEAK_FIT)/manifest.json
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $* --threads $(THREADS) --quiet $(OTHER)
