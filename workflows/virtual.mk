# The virtual campaign of a study whose truth is known: workflows/<study>_virtual diagnoses what steps 3 and 4 of the study itself made of
# it, so that nothing but its step 9 runs. The scorer, which alone reads the truth, then holds the answer against what was hidden; the report opens
# with that.
VIRTUAL := $(if $(wildcard $(WORKFLOW)_virtual/study.toml),$(STUDY)_virtual)
ifneq ($(VIRTUAL),)
VIRTUAL_DIAGNOSIS := results/$(VIRTUAL)/s9_diagnosis/manifest.json
SCORE := results/$(VIRTUAL)/score/score.json
.PRECIOUS: $(VIRTUAL_DIAGNOSIS)

$(VIRTUAL_DIAGNOSIS): $(call FILES,workflows/$(VIRTUAL)/*.toml $(WORKFLOW)/hypotheses/*.toml) $(BIN)/s9_diagnosis \
    $(RESULTS)/s3_identification/manifest.json $(RESULTS)/s4_refinement/manifest.json
	@$(BIN)/s9_diagnosis --study workflows/$(VIRTUAL) --results results/$(VIRTUAL) --out results/$(VIRTUAL)/s9_diagnosis --threads $(THREADS)

$(SCORE): $(VIRTUAL_DIAGNOSIS) $(RESULTS)/s0_campaign/manifest.json $(PRODUCT)tests/steps/diagnosis_score.py
	@$(PRODUCT)workflows/python.sh $(PRODUCT)tests/steps/diagnosis_score.py --campaign $(RESULTS)/s0_campaign --imposed $(WORKFLOW)/s0_campaign.toml \
	  --diagnosis results/$(VIRTUAL)/s9_diagnosis --out results/$(VIRTUAL)/score
endif
