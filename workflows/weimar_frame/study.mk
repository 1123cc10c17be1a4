# Records that lie elsewhere: DATA=dir names their folder. A small campaign that points at them is written under results/; nothing of
# them is kept here.
CAMPAIGN := $(RESULTS)/campaign

INPUTS_s3_identification += $(CAMPAIGN)/campaign.toml

$(CAMPAIGN)/campaign.toml: $(WORKFLOW)/campaign.py $(if $(DATA),$(call FILES,$(DATA)/setup_*_channel_dofs.txt $(DATA)/grid.txt))
	@$(if $(DATA),,$(if $(wildcard $(CAMPAIGN)/campaign.toml),,echo "$(STUDY): give the folder of the records, make s3 STUDY=$(STUDY) DATA=dir" >&2; exit 2))
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/campaign.py '$(DATA)' $(CAMPAIGN)

# Steps 4 and 6 take what is written at its word. Step 9 does not, and not what was fitted to these frequencies before either: a first
# look from the open model, with room for two causes, then the diagnosis from the model that it leaves.
FIRST_LOOK := $(RESULTS)/first_look
INPUTS_s9_diagnosis += $(FIRST_LOOK)/manifest.json $(call FILES,$(WORKFLOW)/hypotheses/*.toml)

$(FIRST_LOOK)/manifest.json: $(STUDY_INPUTS) $(call FILES,$(WORKFLOW)/hypotheses/*.toml) $(WORKFLOW)/s9_diagnosis.toml $(BIN)/s9_diagnosis \
    $(RESULTS)/s3_identification/manifest.json
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --model $(RESULTS)/inputs/model_open --out $(FIRST_LOOK) \
	  --threads $(THREADS) --set most_causes=2
