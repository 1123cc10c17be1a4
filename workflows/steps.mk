# One rule a step, for every study. A step's target is its manifest, which is written last; it depends on its configuration, the
# study's, its executable, and the manifests of the steps that it reads. A step without a configuration file runs on its defaults.

STEP_MANIFESTS := $(STEPS:%=$(RESULTS)/%/manifest.json)
STUDY_INPUTS := $(WORKFLOW)/study.toml $(call FILES,data/$(STUDY)/bridge.toml data/$(STUDY)/features/* data/$(STUDY)/model/* data/$(STUDY)/*.inp)

# What each step reads of earlier ones.
READS_s1_model :=
READS_s2_sensors := s1_model
READS_s3_identification := s0_campaign
READS_s4_refinement := s1_model
READS_s5_sensitivity := s4_refinement
READS_s6_updating := s4_refinement s5_sensitivity
READS_s7_aerodynamics := s6_updating
READS_s8_validation := s0_campaign s6_updating s7_aerodynamics
READS_s9_diagnosis := s4_refinement s6_updating
READS_s10_reliability := s6_updating s7_aerodynamics

# Measured modes that step 3 of the study identifies: the steps that compare with them wait for it.
ifneq ($(shell grep -s '^features *=.*s3_identification/features' $(WORKFLOW)/study.toml),)
READS_s4_refinement += s3_identification
READS_s6_updating += s3_identification
READS_s9_diagnosis += s3_identification
READS_s10_reliability += s3_identification
# study.toml names them where results usually lie.
ELSEWHERE := $(if $(filter-out results/$(STUDY),$(RESULTS)),--features $(RESULTS)/s3_identification/features)
endif

# What a step reads of the study's data beside STUDY_INPUTS.
INPUTS_s0_campaign := $(call FILES,data/$(STUDY)/virtual/* data/$(STUDY)/layout/*)
INPUTS_s2_sensors := $(call FILES, data/$(STUDY)/layout/*)
INPUTS_s7_aerodynamics := $(call FILES, data/$(STUDY)/aero/*.csv)

# Records of one's own, which step 3 reads by itself: data/<study>/campaign/.
ifneq ($(wildcard data/$(STUDY)/campaign/campaign.toml),)
INPUTS_s3_identification := $(call FILES,data/$(STUDY)/campaign/* data/$(STUDY)/campaign/records/*)
INPUTS_s1_model := $(call FILES,data/$(STUDY)/campaign/channels.csv)
endif

# A study of outside records makes its inputs from them once: make s9 STUDY=gt_pedestrian_bridge DATA=dir
ifneq ($(wildcard $(WORKFLOW)/make_inputs.py),)
STUDY_INPUTS += $(RESULTS)/inputs/model/model.toml
$(RESULTS)/inputs/model/model.toml: $(WORKFLOW)/make_inputs.py $(call FILES,$(PRODUCT)workflows/common/*.py)
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/make_inputs.py '$(DATA)' $(RESULTS)/inputs
endif

# Somebody's own measured modes: make s6 MODES=dir
MEASURED := $(if $(MODES),--modes '$(MODES)') $(if $(FEATURES),--features '$(FEATURES)')
OPTIONS_s4_refinement := $(or $(strip $(MEASURED)),$(ELSEWHERE))
OPTIONS_s6_updating := $(or $(strip $(MEASURED)),$(ELSEWHERE))
OPTIONS_s10_reliability := $(or $(strip $(MEASURED)),$(ELSEWHERE))
# Which modes the results rest on is kept beside them, so that the steps run again when that changes, and only then. It is written by a
# recipe, so that `make -n` writes nothing.
MEASURED_STAMP := $(RESULTS)/.measured
ifneq ($(strip $(MEASURED) $(wildcard $(MEASURED_STAMP))),)
ifneq ($(strip $(shell cat $(MEASURED_STAMP) 2>/dev/null)),$(strip measured: $(MEASURED)))
$(MEASURED_STAMP): FORCE
	@mkdir -p $(@D) && echo "measured: $(strip $(MEASURED))" > $@
endif
INPUTS_s4_refinement += $(MEASURED_STAMP) $(call FILES,$(MODES:%=%/*) $(FEATURES:%=%/*))
INPUTS_s6_updating += $(MEASURED_STAMP) $(call FILES,$(MODES:%=%/*) $(FEATURES:%=%/*))
endif

# What a study has of its own, such as a campaign made of records that lie elsewhere.
-include $(WORKFLOW)/study.mk

# A study of simulated records, workflows/<study>_virtual, is a study like every other, and another one shows its results. What is read of
# it is made first: step 0, whose wind events step 8 compares with, then its page, which needs all the rest. One after the other, as two
# makes at once would write the same files.
VIRTUAL := $(if $(wildcard $(WORKFLOW)_virtual/study.toml),$(STUDY)_virtual)
ifneq ($(VIRTUAL),)
OF_VIRTUAL = $(MAKE) --no-print-directory -f $(PRODUCT)Makefile STUDY=$(VIRTUAL) RESULTS=$(RESULTS)_virtual FEATURES= MODES=
VIRTUAL_EVENTS := $(RESULTS)_virtual/s0_campaign/manifest.json
VIRTUAL_PAGE := $(RESULTS)_virtual/report/report.html
INPUTS_s8_validation += $(VIRTUAL_EVENTS)
# The configuration names the campaign where the results are in their own place.
OPTIONS_s8_validation := $(if $(filter results/$(STUDY),$(RESULTS)),,--campaign $(RESULTS)_virtual/s0_campaign)
$(VIRTUAL_EVENTS) $(VIRTUAL_PAGE): FORCE $(if $(NO_BUILD),,build)
	+@$(OF_VIRTUAL) $@ $(if $(filter executables,$(EXECUTABLES)),NO_BUILD=1)
$(VIRTUAL_PAGE): $(VIRTUAL_EVENTS)
# Steps that it alone has: make s3
OF_VIRTUAL_ALONE := $(filter-out $(STEPS),$(shell $(PRODUCT)workflows/study_steps.sh $(WORKFLOW)_virtual))
OF_VIRTUAL_ALONE += $(foreach step,$(OF_VIRTUAL_ALONE),$(firstword $(subst _, ,$(step))))
.PHONY: $(OF_VIRTUAL_ALONE)
$(OF_VIRTUAL_ALONE):
	+@$(OF_VIRTUAL) $@
else ifneq ($(and $(filter s0_campaign,$(STEPS)),$(filter s9_diagnosis,$(STEPS))),)
# Its truth is known. The scorer, which alone reads it, holds diagnosis and updating against what was hidden.
SCORE := $(RESULTS)/score/score.json
SCORED := $(filter s0_campaign s4_refinement s6_updating s9_diagnosis,$(STEPS))
$(SCORE): $(SCORED:%=$(RESULTS)/%/manifest.json) $(PRODUCT)tests/steps/diagnosis_score.py $(PRODUCT)tests/steps/parameter_score.py
	@$(PRODUCT)workflows/python.sh $(PRODUCT)tests/steps/diagnosis_score.py --campaign $(RESULTS)/s0_campaign --imposed $(WORKFLOW)/s0_campaign.toml \
	  --diagnosis $(RESULTS)/s9_diagnosis --out $(RESULTS)/score \
	  $(if $(filter s6_updating,$(SCORED)),--updating $(RESULTS)/s6_updating --model $(RESULTS)/s4_refinement/model)
endif
OPTIONS_s9_diagnosis += $(or $(if $(FEATURES),--features '$(FEATURES)'),$(ELSEWHERE))

# An executable is as new as its last link: ninja leaves it alone when nothing changed, and then no step runs.
# NO_BUILD=1 takes the executables as they are.
ifndef NO_BUILD
# `build` compiles what was asked for; what a study's own rules (study.mk) need beside that is compiled here.
$(STEPS:%=$(BIN)/%): build
	@$(if $(filter executables $(@F),$(EXECUTABLES)),:,flock $(BUILD) cmake --build $(BUILD) -j $(JOBS) --target $(@F))
else
$(STEPS:%=$(BIN)/%):
	@echo "$@ is not there: $(if $(INSTALLED),install twindeck again,make build)" >&2; exit 2
endif

# All that a step reads: files of the study, what its scripts make, results of earlier steps.
INPUTS_OF = $(call PLAIN,$(STUDY_INPUTS) $(INPUTS_$(1))) $(foreach read,$(filter $(READS_$(1)),$(STEPS)),$(RESULTS)/$(read)/manifest.json)

define step_rule
.PHONY: $(firstword $(subst _, ,$(1))) $(1)
$(firstword $(subst _, ,$(1))) $(1): $(RESULTS)/$(1)/manifest.json
$(RESULTS)/$(1)/manifest.json: $(call INPUTS_OF,$(1)) $(wildcard $(WORKFLOW)/$(1).toml) $(BIN)/$(1)
	@n=0; for step in $(STEPS); do n=$$$$((n + 1)); [ $$$$step != $(1) ] || break; done; echo "step $$$$n of $(words $(STEPS)): $(1)" >&2
	@$(BIN)/$(1) --study $(WORKFLOW) --results $(RESULTS) --out $(RESULTS)/$(1) --threads $(THREADS) $$(OPTIONS_$(1)) $(if $(filter all $(1) $(firstword $(subst _, ,$(1))),$(ACCEPT)),--accept-unconverged)
endef
$(foreach step,$(STEPS),$(eval $(call step_rule,$(step))))

# And what it read when it ran, as its manifest lists it: a file that was edited since, wherever it lies, or that is gone makes it run again.
# In a folder outside the study's own, which its configuration names, a new file does so too.
RECORDED := $(shell $(PRODUCT)workflows/recorded_inputs.sh $(RESULTS) "$(STEPS)")
$(foreach rule,$(RECORDED),$(eval $(subst {blank},\ ,$(rule))))
OWN_FOLDERS := ./ $(WORKFLOW)/% data/$(STUDY)/% $(RESULTS)/%
FOLDERS_OF = $(filter-out $(OWN_FOLDERS),$(sort $(dir $(patsubst $(1):%,%,$(filter $(1):%,$(RECORDED))))))
define new_files_rule
$(1): $(foreach folder,$(call FOLDERS_OF,$(1)),$(call FILES,$(folder)*.toml $(folder)*.csv))
endef
$(foreach manifest,$(STEP_MANIFESTS),$(eval $(call new_files_rule,$(manifest))))

# A step replaces its folder as a whole. Interrupted a moment later, make would delete the manifest that is there by then and leave a folder
# that no step takes for its own.
.PRECIOUS: $(STEP_MANIFESTS) $(foreach step,$(STEPS),$(filter %/manifest.json,$(INPUTS_$(step)))) $(RESULTS)/tables/manifest.json $(RESULTS)/figures/manifest.json

# make check: a step whose inputs are not all there yet is asked for its configuration alone.
MISSING = $(patsubst $(RESULTS)/%/manifest.json,%,$(filter-out $(MEASURED_STAMP) $(wildcard $(call INPUTS_OF,$(1))),$(call INPUTS_OF,$(1))))
CHECKED = $(if $(MISSING),$(BIN)/$(1) --print-config --study $(WORKFLOW) >/dev/null && echo "$(1): configuration is valid; inputs wait for $(MISSING)", \
  $(BIN)/$(1) --check --study $(WORKFLOW) --results $(RESULTS) --out $(RESULTS)/$(1) $(OPTIONS_$(1)))
