# One pair of the exam: make all STUDY=iasc_asce CASE=3 PATTERN=4 DRAW=1. The records are computed (records.py), nothing is read from outside.
CASE ?= 3
PATTERN ?= 4
DRAW ?= 1
CAMPAIGN := $(RESULTS)/campaign
PAIR := case $(CASE), pattern $(PATTERN), draw $(DRAW)
PAIR_STAMP := $(RESULTS)/.pair

INPUTS_s3_identification += $(CAMPAIGN)/campaign.toml

# Which pair the records are of is kept beside them, so that they are made again when that changes, and only then.
ifneq ($(strip $(shell cat $(PAIR_STAMP) 2>/dev/null)),$(PAIR))
$(PAIR_STAMP): FORCE
	@mkdir -p $(@D) && echo "$(PAIR)" > $@
endif

$(CAMPAIGN)/campaign.toml: $(PAIR_STAMP) $(WORKFLOW)/records.py $(WORKFLOW)/frame.py
	@$(PRODUCT)workflows/python.sh $(WORKFLOW)/records.py $(CAMPAIGN) --case $(CASE) --patterns 0 $(PATTERN) --seed $(DRAW)
