"""Runs a page in headless Chromium."""
import json
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent


def result_of(folder, page, options=(), **mounts):
    """`window.result` of a page of `folder`; each further folder is served under its name, npm packages under modules/.
    `options`: those of run_page.mjs."""
    command = ["node", HERE / "run_page.mjs", folder, page, *(f"{name}={path}" for name, path in mounts.items()), *options]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
