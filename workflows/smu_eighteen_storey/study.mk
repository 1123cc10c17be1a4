# The same diagnosis within the authors' bounds, and of a model that bends as a whole too.
BESIDE := $(RESULTS)/as_published $(RESULTS)/with_bending

INPUTS_s9_diagnosis += $(BESIDE:%=%/manifest.json)

$(RESULTS)/as_published/manifest.json: MODEL := $(RESULTS)/inputs/published_model
$(RESULTS)/with_bending/manifest.json: MODEL := $(RESULTS)/inputs/bending_model
$(BESIDE:%=%/manifest.json): %/manifest.json: $(RESULTS)/inputs/model/model.toml $(WORKFLOW)/s9_diagnosis.toml $(BIN)/s9_diagnosis
	@$(BIN)/s9_diagnosis --study $(WORKFLOW) --results $(RESULTS) --out $* --model $(MODEL) --threads $(THREADS) --quiet
