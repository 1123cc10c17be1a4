# twindeck: `make all` reproduces the study, `make test` checks the product. `make` alone prints this page's targets.
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules
SHELL := /bin/sh

STUDY ?= ponte_del_mare
BUILD ?= build
THREADS ?= 2
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
BIN := $(BUILD)/bin
RESULTS := results/$(STUDY)
WORKFLOW := workflows/$(STUDY)
DATA ?=
PAPER := data/$(STUDY)
REPORT := workflows/python.sh -m twindeck_report

include workflows/steps.mk

.PHONY: help all deps build test unit steps tables figures report verify smoke why clean FORCE

help: ## this page
	@echo "twindeck: what does the model get wrong, why, and how much better is it with the cause in the model?"
	@echo
	@sed -n 's/^\([a-z_]*\):.*## \(.*\)/  make \1 |\2/p' $(firstword $(MAKEFILE_LIST)) | column -t -s '|' 2>/dev/null \
	  || sed -n 's/^\([a-z_]*\):.*## \(.*\)/  make \1: \2/p' $(firstword $(MAKEFILE_LIST))
	@echo
	@echo "  make sN          step N of the study (s1_model … ): $(STEPS)"
	@echo "  STUDY=$(STUDY)   the study; MODES=dir  measured modes of your own for s4 and s6; THREADS=$(THREADS)"

all: report verify ## everything of the study: install, build, steps, tables, figures, report, check against the paper

deps: ## what is missing is installed (apt, as root or with sudo); prints nothing when all is there
	@workflows/deps.sh

build: deps ## compile into build/
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release >$(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log
	@cmake --build $(BUILD) -j $(JOBS) --target executables

test: build ## unit tests, laws, verification, steps, architecture, the study and its check against the paper
	@cmake --build $(BUILD) -j $(JOBS)
	@cd $(BUILD) && ctest --output-on-failure -j $(JOBS)
	@$(MAKE) --no-print-directory all

steps: $(STEP_MANIFESTS) ## every step of the study

tables: $(RESULTS)/tables/manifest.json ## tables as CSV, TeX, HTML
figures: $(RESULTS)/figures/manifest.json ## figures as PDF, PNG and their data
report: $(RESULTS)/report/report.html ## one self-contained page

REPORT_SOURCES := $(shell find paper data/$(STUDY) -type f -not -path '*/__pycache__/*' 2>/dev/null)
REPORT_ARGUMENTS = --study $(STUDY) --results $(RESULTS) --data $(PAPER)

$(RESULTS)/tables/manifest.json: $(STEP_MANIFESTS) $(REPORT_SOURCES) workflows/python.sh
	@$(REPORT) tables $(REPORT_ARGUMENTS)

$(RESULTS)/figures/manifest.json: $(STEP_MANIFESTS) $(REPORT_SOURCES) workflows/python.sh
	@$(REPORT) figures $(REPORT_ARGUMENTS)

$(RESULTS)/report/report.html: $(RESULTS)/tables/manifest.json $(RESULTS)/figures/manifest.json
	@$(REPORT) report $(REPORT_ARGUMENTS)

verify: $(RESULTS)/report/report.html ## hold the tables, as they lie there, against the paper within the declared tolerances
	@$(REPORT) verify $(REPORT_ARGUMENTS)

smoke: build ## the whole chain, small, under results/smoke
	@$(MAKE) --no-print-directory steps STUDY=smoke

why: ## make why STEP=s6: why that step would run again
	@$(MAKE) --no-print-directory -n --debug=b $(STEP) STUDY=$(STUDY) NO_BUILD=1 2>/dev/null | grep -E "newer than target|does not exist" || echo "$(STEP): up to date"

clean: ## remove the build and all results
	@rm -rf $(BUILD) && find results -mindepth 1 -not -name README.md -delete
