# Records that lie elsewhere: DATA=dir names their folder. The channels that are used are copied under results/; nothing of them is kept
# here.
CAMPAIGN := $(RESULTS)/campaign
OPTIONS_s3_identification += --campaign $(CAMPAIGN)

$(RESULTS)/s3_identification/manifest.json: $(CAMPAIGN)/campaign.toml

$(CAMPAIGN)/campaign.toml: $(WORKFLOW)/campaign.py $(if $(DATA),$(wildcard $(DATA)/channels.csv $(DATA)/*.npy))
	@$(if $(DATA),,$(if $(wildcard $(CAMPAIGN)/campaign.toml),,echo "$(STUDY): give the folder of the records, make s3 STUDY=$(STUDY) DATA=dir" >&2; exit 2))
	@workflows/python.sh $(WORKFLOW)/campaign.py $(DATA) $(CAMPAIGN)
