#!/usr/bin/env bash
# Installs what is missing: Debian packages (scripts/packages.txt), Python packages (scripts/requirements.txt) into .venv,
# and the browser tests' npm packages (tests/browser/package-lock.json).
# Safe to run again: it does nothing when everything is there.
set -euo pipefail
cd "$(dirname "$0")/.."

wanted=$(grep -vE '^(#|$)' scripts/packages.txt)
missing=""
for package in $wanted; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
# Other packagings of Node.js bring npm along and conflict with Debian's npm.
command -v npm >/dev/null || missing="$missing nodejs npm"
if [ -n "$missing" ]; then
  echo "setup: installing$missing" >&2
  as_root=""
  [ "$(id -u)" = 0 ] || as_root=sudo
  $as_root apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
fi

stamp=.venv/requirements.stamp
if ! cmp -s scripts/requirements.txt "$stamp"; then
  echo "setup: Python packages into .venv" >&2
  [ -x .venv/bin/python ] || /usr/bin/python3 -m venv .venv
  .venv/bin/python -m pip install --quiet --disable-pip-version-check -r scripts/requirements.txt
  cp scripts/requirements.txt "$stamp"
fi

# The module `cuticle` as the preset `release` builds it, for `.venv/bin/python -c "import cuticle"`.
echo "$PWD/build/release/python" >"$(.venv/bin/python -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')/cuticle.pth"

packages=tests/browser/node_modules
if ! cmp -s tests/browser/package-lock.json "$packages/installed.lock"; then
  echo "setup: npm packages into $packages" >&2
  npm ci --prefix tests/browser --silent --no-audit --no-fund
  cp tests/browser/package-lock.json "$packages/installed.lock"
fi
