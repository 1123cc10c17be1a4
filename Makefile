# twindeck: `make all` reproduces the study, `make test` checks the product. `make` alone prints the targets that a user needs.
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules
SHELL := /bin/sh

# The product's own files lie beside this one. In the source tree that is the current folder (empty); `make install` puts them into
# <prefix>/share/twindeck/ and the executables into <prefix>/bin, and `twindeck run` reads this file there from a folder of the user's.
PRODUCT := $(filter-out ./,$(dir $(firstword $(MAKEFILE_LIST))))
include $(PRODUCT)workflows/names.mk
STUDY ?= ponte_del_mare
BUILD ?= build
THREADS ?= 2
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
INSTALLED := $(if $(PRODUCT),$(if $(wildcard $(PRODUCT)CMakeLists.txt),,yes))
ifeq ($(INSTALLED),)
BIN := $(BUILD)/bin
else
BIN := $(abspath $(PRODUCT)../../bin)
NO_BUILD := 1
endif
RESULTS := results/$(STUDY)
WORKFLOW := workflows/$(STUDY)
DATA ?=
PAPER := data/$(STUDY)
REPORT := $(PRODUCT)workflows/python.sh -m twindeck_report

include $(PRODUCT)workflows/study_steps.mk
# `make why s6`: the words after `why` name a step; they are not built.
ifeq ($(firstword $(MAKECMDGOALS)),why)
STEP ?= $(word 2,$(MAKECMDGOALS))
$(filter-out why,$(MAKECMDGOALS)): why ; @:
else
include $(PRODUCT)workflows/steps.mk
endif

.PHONY: bench-places check compare xlsx decks baseline moves prose checksums check-power paper blind-trials blind-modes score help help-all all look deps build test unit steps tables figures report verify \
  smoke bench growth format fuzz sanitize processors reproduce-check calibrate calibrate-trade why new reference clean install package bare-root release coverage mutants hold docs FORCE

# What one needs who uses the product; `make help-all` lists what its developers need as well.
FOR_USERS := look all new check report verify compare why install test
LISTED = sed -n $(foreach target,$(1),-e 's/^\($(target)\):.*$(hash)$(hash) \(.*\)/  make \1 |\2/p') $(firstword $(MAKEFILE_LIST)) | { column -t -s '|' 2>/dev/null || cat; }

help: ## the targets that a user needs
	@echo "twindeck: what does the model get wrong, why, and how much better is it with the cause in the model?"
	@echo
	@$(call LISTED,$(FOR_USERS))
	@echo
	@echo "  make sN          step N of the study (s1_model … ): $(STEPS)"
	@echo "  STUDY=$(STUDY)   the study; MODES=dir  measured modes of your own for s4 and s6; THREADS=$(THREADS)"
	@echo "  ACCEPT=sN        publish what step N found though it did not converge, marked as such, and go on"
	@echo "  make help-all    every target"

help-all: ## every target
	@$(call LISTED,[a-z_-]*)

all: report verify ## everything of the study, and of the one of simulated records beside it: install, build, steps, tables, figures, report, check against the paper

deps: ## packages and versions; what is missing is installed (apt, as root or with sudo)
	@workflows/deps.sh $(if $(filter deps,$(MAKECMDGOALS)),--report)

# What is compiled: the steps that are asked for and those before them; everything when anything else is asked for too.
STEP_OF = $(foreach step,$(STEPS),$(if $(filter $(1),$(step) $(firstword $(subst _, ,$(step)))),$(step)))
WITH_EARLIER = $(1) $(foreach read,$(filter $(READS_$(1)),$(STEPS)),$(call WITH_EARLIER,$(read)))
ASKED := $(MAKECMDGOALS:look=s1)
ASKED_STEPS := $(foreach goal,$(ASKED),$(call STEP_OF,$(goal)))
EXECUTABLES := $(if $(filter $(words $(ASKED)),$(words $(ASKED_STEPS))),$(sort $(foreach step,$(ASKED_STEPS),$(call WITH_EARLIER,$(step)))))
EXECUTABLES := $(or $(strip $(EXECUTABLES)),executables)

build: deps ## compile into build/
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release >$(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log
	@cmake --build $(BUILD) -j $(JOBS) --target $(EXECUTABLES)

test: build ## unit tests, laws, verification, steps, architecture, the study and its check against the paper
	@cmake --build $(BUILD) -j $(JOBS)
	@$(MAKE) --no-print-directory $(if $(SCORE)$(VIRTUAL),score,s3) NO_BUILD=1
	@cd $(BUILD) && OPENBLAS_CORETYPE=$${OPENBLAS_CORETYPE-Haswell} ctest --output-on-failure -j $(JOBS) # as the steps do
	@$(MAKE) --no-print-directory all

look: $(RESULTS)/s1_model/manifest.json ## a first look: compiles step 1 alone, runs it and draws the model's modes 1 and 2
	@$(REPORT) figures --only fig_05 $(REPORT_ARGUMENTS)

steps: $(STEP_MANIFESTS) ## every step of the study

check: $(STEPS:%=$(BIN)/%) ## validate every input of every step, and tell what would run and how long; nothing is computed or written
	@failed=0; $(foreach step,$(STEPS),$(call CHECKED,$(step)) || failed=2;) exit $$failed

score: $(SCORE) ## diagnosis and updating on simulated records, held against what was hidden in them (the scorer alone reads the truth)
	$(if $(VIRTUAL),+@$(OF_VIRTUAL) score,@$(if $(SCORE),:,echo "score: study $(STUDY) has no simulated records: no s0_campaign with s9_diagnosis, no workflows/$(STUDY)_virtual" >&2; exit 2))

tables: $(RESULTS)/tables/manifest.json ## tables as CSV, TeX, HTML
figures: $(RESULTS)/figures/manifest.json ## figures as PDF, PNG and their data
report: $(RESULTS)/report/report.html ## one self-contained page; refused where a file was changed after it was written
	@$(REPORT) unchanged $(REPORT_ARGUMENTS)

REPORT_SOURCES := $(wildcard $(call PLAIN,$(shell find $(PRODUCT)paper data/$(STUDY) -type f -not -path '*/__pycache__/*' -not -path '*paper/article/*' 2>/dev/null)))
REPORT_ARGUMENTS = --study $(STUDY) --results $(RESULTS) --data $(PAPER)

$(RESULTS)/tables/manifest.json: $(STEP_MANIFESTS) $(VIRTUAL_PAGE) $(REPORT_SOURCES) $(PRODUCT)workflows/python.sh
	@$(REPORT) tables $(REPORT_ARGUMENTS)

$(RESULTS)/figures/manifest.json: $(STEP_MANIFESTS) $(VIRTUAL_PAGE) $(REPORT_SOURCES) $(call FILES,results/scoring/*.csv) $(PRODUCT)workflows/python.sh
	@$(REPORT) figures $(REPORT_ARGUMENTS)

$(RESULTS)/report/report.html: $(RESULTS)/tables/manifest.json $(RESULTS)/figures/manifest.json $(wildcard results/check_power/power.csv) $(SCORE)
	@$(REPORT) report $(REPORT_ARGUMENTS)

paper: $(RESULTS)/paper/paper.pdf ## our article as PDF, with the generated tables, figures and numbers (needs LaTeX; says how to get it)

$(RESULTS)/paper/paper.pdf: $(RESULTS)/report/report.html $(shell find $(PRODUCT)paper/article -name '*.tex')
	@$(REPORT) article $(REPORT_ARGUMENTS)

verify: $(RESULTS)/report/report.html ## hold the tables, as they lie there, against the paper within the declared tolerances
	@$(REPORT) verify $(REPORT_ARGUMENTS)

baseline: ## hold every computed cell of the study where it is now (ratchet_baseline.csv); empties the list of excused moves
	@$(REPORT) baseline $(REPORT_ARGUMENTS)

moves: ## make moves REASON="...": excuse the cells that moved since the baseline, each with its old and new value
	@$(REPORT) moves $(REPORT_ARGUMENTS)

prose: ## write into the guides and README.md the numbers that they tell of the results (`make verify` fails where they say others)
	@$(REPORT) prose $(REPORT_ARGUMENTS)

checksums: ## list the input files anew in data/SHA256SUMS
	@$(REPORT) checksums $(REPORT_ARGUMENTS)

ONLY ?=
check-power: build ## change the inputs one at a time and see what the check notices (ONLY=name for one; results/check_power/power.csv)
	@$(PRODUCT)workflows/python.sh -m twindeck_power --study $(STUDY) --bin $(BIN) $(ONLY:%=--only %)

smoke: build ## the whole chain, small, under results/smoke
	@$(MAKE) --no-print-directory steps STUDY=smoke

N ?= $(if $(filter exam,$(TIER)),45,$(if $(filter chain,$(TIER)),40,$(if $(filter matrices,$(TIER)),16,400)))
TIER ?= features
SEED ?= 1
WITH ?=
BLIND = $(if $(filter features,$(TIER)),blind_trials,$(if $(filter form,$(TIER)),blind_form,blind_records))
BLIND_LAST = $(if $(filter form,$(TIER)),results/blind/form_$(SEED)_$(N).csv,$(filter-out features,$(TIER)))
blind-trials: build ## make blind-trials N=400 TIER=features, form, exam, chain, matrices or time (exam and chain: from raw records; matrices: of a real bridge, in ../shared; WITH="…" for their options): hidden effects looked for, scored with intervals
ifneq ($(filter exam chain matrices,$(TIER)),)
	@$(PRODUCT)workflows/python.sh tests/blind/$(TIER)/$(TIER).py $(BIN) results/$(TIER) $(N) $(SEED) $(WITH)
else
	@cmake --build $(BUILD) -j $(JOBS) --target $(BLIND)
	@$(BUILD)/bin/$(BLIND) $(N) $(SEED) $(BLIND_LAST)
endif

blind-modes: build ## make blind-modes N=200 SEED=1: records of random structures identified by the automatic rule, scored with exact intervals (results/blind/modes_SEED_N.csv)
	@cmake --build $(BUILD) -j $(JOBS) --target blind_modes
	@$(BUILD)/bin/blind_modes $(N) $(SEED) results/blind/modes_$(SEED)_$(N).csv

decks: build ## every deck of Nastran, Abaqus, CalculiX, ANSYS and SAP2000 whose frequencies are known, imported and compared (results/decks/frequencies.csv)
	@cmake --build $(BUILD) -j $(JOBS) --target test_model_io
	@mkdir -p results/decks && rm -f results/decks/frequencies.csv
	@TWINDECK_DECK_TABLE=results/decks/frequencies.csv $(BUILD)/bin/test_model_io --gtest_brief=1 --gtest_filter='KnownDecks*:PublicInpDecks*:NastranDecks*:AnsysDecks*:AnsysManual*:DeckStage*:QuadraticDecks*:Sap2000*:InpAxes*:ThickShells*' >/dev/null
	@$(PRODUCT)workflows/python.sh tests/data/decks/table.py results/decks/frequencies.csv

BATCH ?= -j$(JOBS)
batch: build ## make batch BATCH="-j2 --config blind_trials=200": many runs as independent jobs of Snakemake (docs/batch.md)
	@command -v snakemake >/dev/null || { echo "batch: snakemake is not here: apt-get install --no-install-recommends snakemake" >&2; exit 2; }
	@cmake --build $(BUILD) -j $(JOBS) --target blind_trials
	@snakemake -s workflows/batch/Snakefile $(BATCH)

bench: build ## ratios against peers: modes, derivatives, identification, wind, reliability (results/bench/*.csv)
	@cmake --build $(BUILD) -j $(JOBS) --target bench_modes bench_identification bench_wind_field bench_reliability
	@$(PRODUCT)workflows/python.sh tests/bench/run.py $(BIN) results/bench $(RUNS)

bench-places: build ## make bench-places PLACES="25 100 400": processor seconds and memory of a diagnosis against candidate places (results/bench/places.csv)
	@mkdir -p results/bench
	@$(PRODUCT)workflows/python.sh tests/bench/places.py $(BIN) results/bench $(PLACES)

SIZES ?=
growth: build ## seconds and memory as models and records grow, with peers and fitted exponents (results/growth; SIZES="modes=deck:3e4,1e5 records=1e5,1e6")
	@cmake --build $(BUILD) -j $(JOBS) --target bench_growth
	@$(PRODUCT)workflows/python.sh tests/bench/growth.py $(BIN) results/growth $(SIZES:%='%')

processors: build ## the study and the tests under the kernels of other processors: tests failed, columns that move (results/processors/*.csv)
	@cmake --build $(BUILD) -j $(JOBS)
	@$(PRODUCT)workflows/python.sh tests/reproduction/processors.py $(BUILD) $(STUDY) $(if $(KERNELS),--kernels $(KERNELS))

reproduce-check: deps ## two clones made from nothing give the same bytes; with clang and for this processor, which columns move (results/reproduce/*.csv)
	@$(PRODUCT)workflows/python.sh tests/reproduction/roots.py $(STUDY)

SECONDS ?= 300
fuzz: ## make fuzz SECONDS=1200: fuzz targets of every reader with clang's libFuzzer and sanitizers, SECONDS shared out
	@/usr/bin/python3 tests/fuzz/run.py $(SECONDS) --jobs $(JOBS)

hold: build ## where a change of numbers is meant: hold those of the smoke chain, of diagnoses and of identified records anew, for the tests that compare them
	@cmake --build $(BUILD) -j $(JOBS) --target blind_form test_blind_modes
	@TWINDECK_HOLD=1 $(BIN)/test_blind_modes --gtest_brief=1
	@TWINDECK_HOLD=1 $(PRODUCT)workflows/python.sh -m unittest tests/steps/test_held_numbers.py
	@OPENBLAS_CORETYPE=Haswell $(BIN)/blind_form 7 9000 --hold tests/blind/form/held_9000.csv

sanitize: ## unit tests, broken inputs and the smoke chain under address, undefined-behaviour and thread sanitizers (ONLY=address or thread)
	@tests/sanitize/run.sh $(JOBS) $(ONLY)

coverage: deps ## lines and branches that the tests of the rooms, laws, verification, steps and the smoke chain reach, by room (build-coverage/coverage.md; needs gcovr)
	@tests/coverage/run.sh $(JOBS) $(ONLY)

mutants: N = 40
mutants: deps ## make mutants N=40 SEED=7: one fault at a time in the rooms of numerics; which do the tests catch? (build-mutants/mutants.csv)
	@/usr/bin/python3 tests/mutants/run.py $(N) $(SEED) --jobs $(JOBS)

TRIAL ?= all_posts_5m
calibrate: build ## fit the bridge's unknown sizes within their ranges (data/$(STUDY)/calibration.toml, TRIAL=all_posts_5m, FROM=values.csv of an earlier fit) and write them into bridge.toml
	@$(BIN)/calibrate_bridge --definition $(PAPER)/calibration.toml --bridge $(PAPER)/bridge.toml --trial $(TRIAL) $(if $(FROM),--from '$(FROM)') --out results/calibration --write

calibrate-trade: build ## frequencies against cable forces against masses: every trial of data/$(STUDY)/calibration.toml, in $(PAPER)/calibration_trade.csv
	@$(BIN)/calibrate_bridge --definition $(PAPER)/calibration.toml --bridge $(PAPER)/bridge.toml --mesh quick --search-mesh quick --out results/calibration_trade --trials
	@cp results/calibration_trade/trade.csv $(PAPER)/calibration_trade.csv

format: ## lay the C++ sources out as .clang-format says (Debian: clang-format)
	@git ls-files 'src/*.[hc]pp' 'tests/*.[hc]pp' | xargs clang-format -i

compare: ## make compare A=results/x B=results/y: two runs beside each other: options, parameters, frequencies, verdicts, what moved by how much
	@$(PRODUCT)workflows/python.sh -m twindeck_compare "$(A)" "$(B)"

xlsx: ## every table of the study's results in one workbook, results/STUDY/tables.xlsx (Debian: python3-openpyxl)
	@$(PRODUCT)workflows/python.sh -m twindeck_export --xlsx 'results/$(STUDY)'

why: ## make why s6: why that step would run again
	@$(PRODUCT)workflows/why.sh "$(STEP)" $(STUDY) $(PRODUCT)Makefile

new: ## make new STUDY=my_bridge: a study of your own, that runs as it stands; TEMPLATE=girder: a footbridge in wind; FROM="logger.csv sensors.csv bridge.inp": out of your own files
	@TWINDECK_BIN="$(BIN)" $(PRODUCT)workflows/new.sh $(if $(filter STUDY,$(GIVEN)),$(STUDY)) $(if $(TEMPLATE),--$(TEMPLATE)) $(if $(FROM),--from $(FROM))

reference: build ## every configuration key and every column of a file, as docs/reference.md
	@$(PRODUCT)workflows/python.sh -m twindeck_reference --bin $(BIN) --out docs/reference.md

docs: build ## guides, reference, decisions, studies and C++ headers as static pages in build/site (needs mkdocs; doxygen for the headers)
	@$(PRODUCT)workflows/python.sh -m twindeck_site --bin $(BIN) --out $(BUILD)/site

PREFIX ?= /usr/local
install: build ## executables, the command twindeck, report, catalogue, manual pages and studies into PREFIX (default /usr/local); DESTDIR counts
	@cmake --build $(BUILD) -j $(JOBS) --target manuals
	@DESTDIR="$(DESTDIR)" cmake --install $(BUILD) --prefix "$(PREFIX)" >$(BUILD)/install.log || { cat $(BUILD)/install.log; exit 1; }
	@echo "installed $$(wc -l <$(BUILD)/install_manifest.txt) files into $(DESTDIR)$(PREFIX); go on with: twindeck new my_bridge"

package: build ## the Debian packages twindeck and twindeck-data, in build/packages
	@cmake --build $(BUILD) -j $(JOBS) --target manuals
	@cd $(BUILD) && cpack -B packages >package.log 2>&1 || { cat package.log; exit 1; }
	@ls $(BUILD)/packages/*.deb

bare-root: ## install the packages of build/packages into a bare Debian 12 and work there without the source tree, or FROM=clone: seconds, exit codes (root; needs debootstrap; BASE=folder)
	@$(PRODUCT)workflows/python.sh $(if $(filter clone,$(FROM)),tests/package/bare_clone.py,tests/package/bare_root.py $(BUILD)/packages) results/bare_root $(if $(BASE),'$(BASE)')

RELEASE := $(BUILD)/release
VERSION = $(shell sed -n 's/^version: //p' CITATION.cff)
release: ## the artefacts of a release in build/release, from what `make package` and `make all` made: packages, results of the study, SHA256SUMS
	@for need in $(BUILD)/packages results/ponte_del_mare/report/report.html; do test -e $$need || { echo "release: $$need is not there: make package all" >&2; exit 2; }; done
	@rm -rf $(RELEASE) && mkdir -p $(RELEASE) && cp $(BUILD)/packages/twindeck*_$(VERSION)_*.deb $(RELEASE)
	@tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -C results -cf - ponte_del_mare $(notdir $(wildcard results/ponte_del_mare_virtual)) \
	  | gzip -n >$(RELEASE)/twindeck-$(VERSION)-results.tar.gz
	@git archive --format=tar --prefix=twindeck-$(VERSION)/ HEAD | gzip -n >$(RELEASE)/twindeck-$(VERSION).tar.gz
	@cd $(RELEASE) && sha256sum *.deb *.tar.gz >SHA256SUMS && cat SHA256SUMS

clean: ## remove the build and all results
	@rm -rf $(BUILD) && find results -mindepth 1 -not -name README.md -delete
