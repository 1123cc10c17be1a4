# Records that lie elsewhere: DATA=dir names their folder. The motion along the table is copied under results/; nothing of it is kept here.
CAMPAIGN := $(RESULTS)/campaign

INPUTS_s3_identification += $(CAMPAIGN)/campaign.toml

$(CAMPAIGN)/campaign.toml: $(WORKFLOW)/campaign.py $(if $(DATA),$(call FILES,$(DATA)/*_northridge_floor?.npy))
	@$(if $(DATA),,$(if $(wildcard $(CAMPAIGN)/campaign.toml),,echo "$(STUDY): give the folder of the records, make s3 STUDY=$(STUDY) DATA=dir" >&2; exit 2))
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/campaign.py '$(DATA)' $(CAMPAIGN)

# Three modes a state and a model of them; the model fitted to the flexible state by its parameters alone; then the diagnosis, which starts from that
# model and asks what changed. with_sensor_scatter: the same with 3 % allowed to shapes (s9_diagnosis.toml).
INPUTS := $(RESULTS)/inputs
REFERENCE_FIT := $(RESULTS)/reference_fit
WIDER := $(RESULTS)/with_sensor_scatter

INPUTS_s9_diagnosis += $(REFERENCE_FIT)/manifest.json $(WIDER)/manifest.json

$(INPUTS)/model/model.toml: $(RESULTS)/s3_identification/manifest.json $(WORKFLOW)/make_model.py $(PRODUCT)workflows/common/shear_building.py
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/make_model.py $(CAMPAIGN) $(RESULTS)/s3_identification/features $(INPUTS)

$(REFERENCE_FIT)/manifest.json: $(INPUTS)/model/model.toml $(WORKFLOW)/s9_diagnosis.toml $(PRODUCT)workflows/common/narrow.py $(BIN)/s9_diagnosis
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(REFERENCE_FIT) --model $(INPUTS)/model \
	  --features $(INPUTS)/reference_features --threads $(THREADS) --quiet --set most_causes=0 --set 'hold_out=["none"]'
	@$(PRODUCT)workflows/python.sh $(PRODUCT)workflows/common/narrow.py $(REFERENCE_FIT)/extended_model $(INPUTS)/fitted_model

$(WIDER)/manifest.json: $(REFERENCE_FIT)/manifest.json
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(WIDER) --threads $(THREADS) --quiet --set scatter.shape_floor=0.03
