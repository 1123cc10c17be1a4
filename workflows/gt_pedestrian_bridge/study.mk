# Each step works on the model as drawn; step 9 too: what was fitted to these frequencies before is no prior for them.
OPTIONS_s4_refinement += --model $(RESULTS)/inputs/model
OPTIONS_s6_updating += --model $(RESULTS)/inputs/model
OPTIONS_s9_diagnosis += --model $(RESULTS)/inputs/model
