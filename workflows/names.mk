# What is given to make by name runs nothing. Every variable of the command line, and each of these wherever it is set, is taken as it stands
# ($(value …): make expands nothing in it) and held against a white list before a shell sees it. Free text has no list: it reaches its program
# by the environment alone.
hash := \#
SIGNS := $$ ; : $(hash) = | % & \ ( ) { } < > ' " ` ! * ? [ ] ~ ^
PLAIN = $(strip $(foreach word,$(1),$(if $(strip $(foreach sign,$(SIGNS),$(findstring $(sign),$(word)))),,$(word))))

NAMES := STUDY STEP
FOLDERS := BUILD BIN
PATHS := A B MODES FEATURES DATA PREFIX DESTDIR FROM BASE
TEXTS := REASON
WORDS := TEMPLATE THREADS JOBS N SEED TIER FORM SECONDS SIZES PLACES RUNS KERNELS TRIAL ONLY BATCH NO_BUILD
# All but the list that make keeps of them.
ON_COMMAND_LINE := $(strip $(foreach variable,$(filter-out -*-command-variables-*-,$(.VARIABLES)),$(if $(filter command,$(origin $(variable))),$(variable))))
ifneq ($(ON_COMMAND_LINE),$(call PLAIN,$(ON_COMMAND_LINE)))
$(error a variable's name holds a sign that is neither a letter, a digit nor _)
endif
WORDS += $(filter-out $(NAMES) $(FOLDERS) $(PATHS) $(TEXTS) $(WORDS),$(ON_COMMAND_LINE))
GIVEN := $(foreach variable,$(NAMES) $(FOLDERS) $(PATHS) $(TEXTS) $(WORDS),$(if $(filter-out undefined default file,$(origin $(variable))),$(variable)))
# What the environment sets gives way to the Makefile's own assignments; what the command line sets does not.
$(foreach variable,$(GIVEN),$(eval $(if $(filter environment,$(origin $(variable))),,override) $(variable) := $$(value $(variable))))
export $(TEXTS)

# The check is one script, which gets each value in single quotes. What would end them, or what make drops on the way, is refused here.
define newline


endef
GOALS := $(MAKECMDGOALS)
TO_CHECK := $(filter-out $(TEXTS),$(GIVEN)) GOALS
$(foreach variable,$(TO_CHECK),$(if $(findstring ',$($(variable)))$(findstring $(newline),$($(variable))),$(error $(variable): holds a quotation mark or the end of a line; leave it out)))
KIND_OF = $(if $(filter $(1),$(NAMES)),name,$(if $(filter $(1),$(FOLDERS)),folder,$(if $(filter $(1),$(PATHS) GOALS),path,words)))
REFUSED := $(shell $(PRODUCT)workflows/check_names.sh $(foreach variable,$(TO_CHECK),'$(call KIND_OF,$(variable)) $(variable)=$($(variable))') 2>&1)
$(if $(filter-out 0,$(.SHELLSTATUS)),$(error $(or $(REFUSED),the names given are too long)))

# Files that a pattern finds. Those whose names hold a sign that make or a shell takes for its own are left out: a rule made of them would
# run it. So are those with a blank, which make takes for two files; what a step read is listed by its manifest all the same.
FILES = $(wildcard $(call PLAIN,$(wildcard $(1))))
