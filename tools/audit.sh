#!/bin/sh
# Known vulnerabilities of the pinned versions, by a database on this machine: docs/how-to/audit.md
#
#     tools/audit.sh [all.zip]
#
# Without a database by the package safety-db, which is of 2021 and so ends as stale. Exit codes: 0 clean,
# 1 vulnerable, 2 not run, 3 stale. `make audit` runs this, but make ends every failure with 2.
project=$(dirname "$0")/..
environment=${VENV:-$project/.venv}/audit
python=$environment/bin/python

not_run() {
	echo "not run: $1"
	exit 2
}

install() {
	"$python" -m pip install --quiet --disable-pip-version-check "$1"
}

if ! "$python" -c "import pip" >/dev/null 2>&1; then # none, or one whose making was interrupted
	"${PYTHON:-python3}" -m venv --clear "$environment" || not_run "no environment can be made in $environment"
fi
install packaging==26.3 || not_run "packaging cannot be installed into $environment"
if [ -z "$1" ]; then
	install safety-db==2021.7.17
fi
"$python" "$project/tools/audit.py" --lock "$project/requirements.lock" ${1:+--advisories "$1"}
