# The updating as its authors did it (their bounds, modes 1 and 2) runs beside the diagnosis: how well it says what it did not see is what
# the diagnosis is held against. Then the changes of stiffness that it ends with, for the report.
PUBLISHED := $(RESULTS)/as_published

INPUTS_s9_diagnosis += $(PUBLISHED)/manifest.json

$(PUBLISHED)/manifest.json: $(RESULTS)/inputs/model/model.toml $(WORKFLOW)/s9_diagnosis.toml $(WORKFLOW)/changes.py $(BIN)/s9_diagnosis
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $(PUBLISHED) --model $(RESULTS)/inputs/published_model \
	  --threads $(THREADS) --quiet
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/changes.py $(PUBLISHED)/extended_model $(RESULTS)/inputs/changes_as_published.csv
