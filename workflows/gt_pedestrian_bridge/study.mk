# Step 9 starts from the model as drawn: what was fitted to these frequencies before is no prior for them.
OPTIONS_s9_diagnosis += --model $(RESULTS)/inputs/model
