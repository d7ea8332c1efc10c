# Two commands set everything up on a fresh machine with Python 3.11, 3.12 or 3.13:
#   make audit   audit two robots, with JSON, certificate and page in audits/
#   make test    run the tests, those of the page in a browser included

PYTHON ?= $(shell command -v python3.11 || command -v python3)
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet -c constraints.txt
AUDIT := $(BIN)/cuspaudit audit --exit-zero

.PHONY: audit test fast lint benchmark browser docs clean

audit: $(VENV)/installed
	@mkdir -p audits
	$(AUDIT) chablat-2022-3r --json audits/chablat-2022-3r.json \
	  --certificate audits/chablat-2022-3r.certificate.json \
	  --html audits/chablat-2022-3r.html
	$(BIN)/cuspaudit verify audits/chablat-2022-3r.certificate.json
	$(AUDIT) ur5_robot --json audits/ur5_robot.json \
	  --certificate audits/ur5_robot.record.json --html audits/ur5_robot.html
	@echo "Open audits/chablat-2022-3r.html and audits/ur5_robot.html in a browser."

test: $(VENV)/installed-test browser
	$(BIN)/python -m pytest -n 2 -q

fast: $(VENV)/installed-test
	$(BIN)/python -m pytest -n 2 -q -m "not slow and not browser"

lint: $(VENV)/installed-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

benchmark: $(VENV)/installed-test
	$(BIN)/python -m pytest tests/benchmarks --benchmark-enable --benchmark-only

# The tests of the page need a Chromium: Debian's is installed where that is possible.
browser:
	@command -v chromium chromium-browser google-chrome >/dev/null 2>&1 \
	  || [ -n "$$CUSPAUDIT_CHROMIUM" ] \
	  || { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null \
	       && apt-get update -qq && apt-get install -y -qq chromium >/dev/null; } \
	  || echo "No Chromium: the browser tests will be skipped. Install it (Debian:" \
	          "apt-get install chromium) or set CUSPAUDIT_CHROMIUM."

$(VENV)/bin/python:
	@command -v $(PYTHON) >/dev/null || { echo "$(PYTHON) not found; set PYTHON"; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/installed: $(VENV)/bin/python pyproject.toml constraints.txt
	@echo "Installing into $(VENV), about 1.7 GB, most of it Pinocchio and its libraries."
	$(PIP) --editable .
	$(BIN)/cuspaudit setup
	@touch $@

$(VENV)/installed-test: $(VENV)/installed
	$(PIP) --editable ".[test,dev]"
	$(PIP) --no-deps robosuite robosuite-models
	@touch $@

docs: $(VENV)/installed
	$(PIP) --editable ".[docs]"
	$(BIN)/mkdocs build --strict --site-dir site

clean:
	rm -rf $(VENV) audits test-output site
