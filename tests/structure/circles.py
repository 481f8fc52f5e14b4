#!/usr/bin/env python3
"""That the house has no circles: no file includes another that includes it, by however many steps, nor does a room; and
rooms use those alone that README.md lists before them.

    tests/structure/circles.py [ROOT]

A file is its header and its source together; a room is a folder below src/ or optimizer/. Prints what is in a circle and
ends with status 1 where there is one.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
TOPS = ("include", "src", "optimizer")


def sources():
    return {path for top in TOPS for path in (ROOT / top).rglob("*") if path.suffix in (".c", ".cc", ".h")}


def included(path, name, known):
    """The file of ours that `name` stands for in `path`; None for others'."""
    for base in (path.parent, *(ROOT / top for top in TOPS)):
        found = pathlib.Path(base, name).resolve()
        if found in known:
            return found
    return None


def arrows(known):
    """What each file takes from others: {file: {files}}, without suffixes."""
    of = {}
    for path in sorted(known):
        own = path.with_suffix("")
        took = {included(path, name, known) for name in INCLUDE.findall(path.read_text(encoding="utf-8"))}
        of.setdefault(own, set()).update(other.with_suffix("") for other in took if other)
        of[own].discard(own)
    return of


def of_rooms(of):
    """The same of the folders that files are in."""
    rooms = {}
    for own, others in of.items():
        rooms.setdefault(own.parent, set()).update(other.parent for other in others if other.parent != own.parent)
    return rooms


def circles(of):
    """What cannot be laid in an order: what nothing uses is taken away from the top, then what uses nothing."""
    left = {own: set(others) for own, others in of.items()}
    while True:
        free = {own for own, others in left.items() if not others & left.keys()}
        used = set().union(*left.values()) if left else set()
        free |= {own for own in left if own not in used}
        if not free:
            return left
        left = {own: others - free for own, others in left.items() if own not in free}


def order():
    """Rooms as README.md's table of folders lists them."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    listed = [ROOT / "include" / "sprayplan"]
    for top in ("src", "optimizer"):
        row = re.search(rf"^\| `{top}/` \|(.*)\|$", text, re.MULTILINE)
        listed += [ROOT / top / name for name in re.findall(r"`([\w/.]+)`", row.group(1)) if (ROOT / top / name).is_dir()]
    return listed


def room_of(folder, rooms):
    return next((room for room in (folder, *folder.parents) if room in rooms), None)


def misplaced(of):
    """Pairs of rooms of which the first is listed before the second and yet uses it."""
    rooms = order()
    place = {room: i for i, room in enumerate(rooms)}
    for own, others in sorted(of.items()):
        for other in sorted(others):
            a, b = room_of(own.parent, place), room_of(other.parent, place)
            if a and b and place[a] < place[b]:
                yield own, other


def short(path):
    return str(path.relative_to(ROOT))


def main():
    known = sources()
    of = arrows(known)
    failed = False
    for kind, found in (("file", circles(of)), ("room", circles(of_rooms(of)))):
        for own in sorted(found):
            failed = True
            print(f"{kind} in a circle: {short(own)} -> {', '.join(sorted(short(other) for other in found[own]))}")
    for own, other in misplaced(of):
        failed = True
        print(f"README.md lists its room first: {short(own)} -> {short(other)}")
    if len(known) < 100:
        failed = True
        print(f"{len(known)} files in {ROOT}, expected the project")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
