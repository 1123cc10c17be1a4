# The campaign and the model are those of ponte_del_mare: its steps 3 and 4 run first where they are stale.
INPUTS_s9_diagnosis += results/ponte_del_mare/s3_identification/manifest.json results/ponte_del_mare/s4_refinement/manifest.json

results/ponte_del_mare/%/manifest.json: FORCE
	@$(MAKE) --no-print-directory -f $(PRODUCT)Makefile STUDY=ponte_del_mare FEATURES= MODES= $*
