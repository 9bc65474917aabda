"""python -m cuticle_report [--demo] DIR"""
import argparse
import pathlib
import sys

from . import ReportError, demo, report, study


def make(options):
    folder = pathlib.Path(options.folder)
    if options.demo:
        demo.make(folder)
    elif (folder / "study.json").is_file():
        study.make(folder)
    else:
        report.make(folder)


def main():
    parser = argparse.ArgumentParser(prog="cuticle_report", description="A self-contained page from the program's data.")
    parser.add_argument("--demo", action="store_true", help="DIR holds demo.json")
    parser.add_argument("folder", metavar="DIR")
    options = parser.parse_args()
    try:
        make(options)
    except ReportError as error:
        print(f"cuticle_report: error: {error}", file=sys.stderr)
        return 3
    return 0


sys.exit(main())
