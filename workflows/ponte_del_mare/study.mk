# Step 9 starts from the refined model of step 4: what was fitted to these frequencies before is no prior for them.
OPTIONS_s9_diagnosis += --model $(RESULTS)/s4_refinement/model
