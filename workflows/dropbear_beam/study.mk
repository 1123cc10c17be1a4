# Records that lie elsewhere: DATA=dir names their folder. Windows of one accelerometer are copied under results/; nothing of them is kept here.
CAMPAIGN := $(RESULTS)/campaign

INPUTS_s3_identification += $(CAMPAIGN)/campaign.toml

$(CAMPAIGN)/campaign.toml: $(WORKFLOW)/campaign.py $(if $(DATA),$(call FILES,$(DATA)/slow10_test?.npy))
	@$(if $(DATA),,$(if $(wildcard $(CAMPAIGN)/campaign.toml),,echo "$(STUDY): give the folder of the records, make s3 STUDY=$(STUDY) DATA=dir" >&2; exit 2))
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/campaign.py '$(DATA)' $(CAMPAIGN)

# Two frequencies of each window and a model of the beam; then one diagnosis a place, each of two states: the reference and that place. The report shows the
# last one (step5, by study.toml); the others lie beside it.
INPUTS := $(RESULTS)/inputs
BESIDE := step1 step2 step3 step4

INPUTS_s9_diagnosis += $(INPUTS)/model/model.toml $(BESIDE:%=$(RESULTS)/%/manifest.json)

$(INPUTS)/model/model.toml: $(RESULTS)/s3_identification/manifest.json $(WORKFLOW)/make_model.py
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/make_model.py $(CAMPAIGN) $(RESULTS)/s3_identification $(INPUTS)

$(BESIDE:%=$(RESULTS)/%/manifest.json): $(RESULTS)/%/manifest.json: $(INPUTS)/model/model.toml $(WORKFLOW)/s9_diagnosis.toml $(BIN)/s9_diagnosis
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(RESULTS)/$* --features $(INPUTS)/features/$* --threads $(THREADS) --quiet
