# The steps of the study as study.toml lists them. What is wrong with the list is said where a step is asked for.
STUDY_STEPS := $(PRODUCT)workflows/study_steps.sh $(WORKFLOW)
STEPS := $(shell $(STUDY_STEPS) 2>/dev/null)
ifneq ($(.SHELLSTATUS),0)
OF_A_STUDY := why all test check steps tables figures report verify paper look score baseline moves check-power
ifneq ($(filter $(OF_A_STUDY) s0% s1% s2% s3% s4% s5% s6% s7% s8% s9%,$(MAKECMDGOALS)),)
$(error $(shell $(STUDY_STEPS) 2>&1 >/dev/null))
endif
endif
