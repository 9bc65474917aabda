"""python -m cuticle_report [--demo] DIR"""
import argparse
import sys

from . import ReportError, demo, study


def main():
    parser = argparse.ArgumentParser(prog="cuticle_report", description="A self-contained page from the program's data.")
    parser.add_argument("--demo", action="store_true", help="DIR holds demo.json, not study.json")
    parser.add_argument("folder", metavar="DIR")
    options = parser.parse_args()
    try:
        (demo if options.demo else study).make(options.folder)
    except ReportError as error:
        print(f"cuticle_report: error: {error}", file=sys.stderr)
        return 3
    return 0


sys.exit(main())
