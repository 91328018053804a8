#!/usr/bin/env bash
# Builds the Python package in a clean virtual environment and runs its tests. PYTHON chooses the interpreter (3.10 or
# later); arguments go to pytest, in the folder of the tests. `PROFILE=quick` builds what one tries things with.
set -euo pipefail
cd "$(dirname "$0")/../python"

venv=$(mktemp -d)
trap 'rm -rf "$venv"' EXIT
"${PYTHON:-python3}" -m venv "$venv"
pip() { "$venv/bin/pip" --quiet --disable-pip-version-check "$@"; }

if [ "${PROFILE:-release}" = quick ]; then
    pip install "maturin>=1.8,<2"
    "$venv/bin/maturin" build --quiet --profile quick --out "$venv/wheels" --interpreter "$venv/bin/python"
    pip install "$venv"/wheels/*.whl
else
    pip install .
fi
pip install pytest "gymnasium>=1.1" pygame
# Not from this folder: its `tiny_physics` is the source, without the built module.
cd tests
"$venv/bin/python" -m pytest -q "$@"
