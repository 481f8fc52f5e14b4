#!/usr/bin/env python3
"""One meaning a name: no type that begins with sp_ is defined in two files.

    tests/structure/names.py [ROOT]

Prints those that are and ends with status 1 where there is one.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
DEFINED = re.compile(r"^(?:\}\s*(sp_\w+);|typedef (?!struct sp_|enum sp_)[^;{]*?\b\(?\*?(sp_\w+)\)?(?:\([^;]*\))?;)", re.MULTILINE)


def definitions():
    """{type: {file}}"""
    of = {}
    for top in ("include", "src", "optimizer"):
        for path in sorted((ROOT / top).rglob("*.[ch]")):
            for names in DEFINED.findall(path.read_text(encoding="utf-8")):
                of.setdefault(next(filter(None, names)), set()).add(path.relative_to(ROOT))
    return of


def main():
    of = definitions()
    if len(of) < 100:
        sys.exit(f"only {len(of)} types found below {ROOT}")
    twice = {name: files for name, files in of.items() if len(files) > 1}
    for name, files in sorted(twice.items()):
        print(f"{name} is defined in {', '.join(map(str, sorted(files)))}")
    sys.exit(1 if twice else 0)


main()
