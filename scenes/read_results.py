#!/usr/bin/env python3
"""Reads what `simulate -o DIR` and `place -o DIR` wrote, and checks that the files agree: an example for scripts and notebooks.

    scenes/read_results.py DIR

Prints coverage and flux by part and the ten worst spots, from texels.vtp; then whether surface.vtp, deposits.exr and
texels.vtp say what result.json says. Ends with status 1 where one does not. Needs nothing but Python 3.8 and its standard
library; where numpy is there arrays are numpy's, else array.array's, of one number after the other.
"""
import array
import itertools
import json
import math
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

try:
    import numpy
except ImportError:
    numpy = None

CODES = {"UInt8": "B", "Int32": "i", "Float32": "f", "Float64": "d"}  # of array and of numpy alike
L_MIN = 60000  # L/min in a m³/s
ROWS_OF_ZIP = 16  # of pixels that OpenEXR deflates together


def numbers(code, data):
    """Little-endian bytes as an array."""
    if numpy:
        return numpy.frombuffer(data, "<" + code)
    values = array.array(code, data)
    if sys.byteorder == "big":
        values.byteswap()
    return values


def read_vtp(path):
    """{name: array} of VTK's XML PolyData with raw appended data; vectors as 3 numbers each; part_names as a list of texts."""
    content = path.read_bytes()
    begin = content.index(b'<AppendedData encoding="raw">')
    data = content[content.index(b"_", begin) + 1:]
    arrays = {}
    for node in ElementTree.fromstring(content[:begin] + b"</VTKFile>").iter("DataArray"):
        offset = int(node.get("offset"))
        size, = struct.unpack_from("<Q", data, offset)
        values = data[offset + 8:offset + 8 + size]
        name = node.get("Name")
        if node.get("type") == "String":
            arrays[name] = values.decode().split("\0")[:-1]
        else:
            arrays[name] = numbers(CODES[node.get("type")], values)
    return arrays


def read_exr_header(content, at):
    """Attributes of one part, {name: bytes}, and where what follows them begins."""
    header = {}
    while content[at]:
        name, kind = content[at:at + 512].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", content, at)
        header[name.decode()] = content[at + 4:at + 4 + size]
        at += 4 + size
    return header, at + 1


def undo_zip(deflated, size):
    """OpenEXR's ZIP: deflated differences of bytes, the even ones first. What would not get shorter is left as it is."""
    if len(deflated) == size:
        return deflated
    steps = zlib.decompress(deflated)
    if numpy:
        parted = (numpy.cumsum(numpy.frombuffer(steps, "u1"), dtype="i8") - 128 * numpy.arange(len(steps))).astype("u1").tobytes()
    else:
        parted = bytes(itertools.accumulate(steps, lambda before, step: before + step - 128 & 255))
    half = (size + 1) // 2
    whole = bytearray(size)
    whole[::2], whole[1::2] = parted[:half], parted[half:]
    return bytes(whole)


def read_exr(path):
    """{part: {channel: [row, ..]}} of OpenEXR files as the program writes them: parts of deflated floats.

    `OpenEXR` and `OpenImageIO`, where their Python modules are there, read these and all others.
    """
    content = path.read_bytes()
    if content[:4] != b"\x76\x2f\x31\x01":
        raise ValueError(f"{path}: no OpenEXR file")
    several = bool(content[5] & 0x10)  # parts, each chunk with its part's number in front
    header, at = read_exr_header(content, 8)
    headers = [header]
    while several and content[at]:
        header, at = read_exr_header(content, at)
        headers.append(header)
    at += several
    parts = {}
    for header in headers:
        channels = [entry.decode() for entry in re.findall(rb"([^\0]+)\0\x02\0\0\0.{12}", header["channels"], re.S)]
        if header["compression"] != b"\3" or len(header["channels"]) != sum(len(name) + 17 for name in channels) + 1:
            raise ValueError(f"{path}: not of floats deflated by sixteen rows")
        left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
        rows = {name: [None] * (bottom - top + 1) for name in channels}
        parts[header.get("name", b"").decode()] = rows
        width, count = right - left + 1, (bottom - top + ROWS_OF_ZIP) // ROWS_OF_ZIP
        for chunk in struct.unpack_from(f"<{count}Q", content, at):
            chunk += 4 * several
            first, length = struct.unpack_from("<2i", content, chunk)
            lines = range(first - top, min(first - top + ROWS_OF_ZIP, bottom - top + 1))
            pixels = undo_zip(content[chunk + 8:chunk + 8 + length], 4 * width * len(channels) * len(lines))
            pieces = (pixels[i:i + 4 * width] for i in range(0, len(pixels), 4 * width))
            for row, name in itertools.product(lines, channels):
                rows[name][row] = numbers("f", next(pieces))
        at += 8 * count
    return parts


def total(*factors):
    """The sum of products, in double precision."""
    if numpy:
        return float(numpy.prod([numpy.asarray(factor, "f8") for factor in factors], axis=0).sum())
    return math.fsum(map(math.prod, zip(*factors)))


def chosen(values, which):
    """Those of values where which is true."""
    return numpy.asarray(values)[numpy.asarray(which, bool)] if numpy else list(itertools.compress(values, which))


def print_parts(texels):
    print(f"{'part':<24} {'area m2':>10} {'coverage %':>10} {'flux L/min/m2':>14}")
    for part, name in enumerate(texels["part_names"]):
        here = [value == part for value in texels["part"]]
        area, covered, flux = (chosen(texels[what], here) for what in ("area", "covered", "flux"))
        whole = total(area)
        if whole > 0:
            print(f"{name:<24} {whole:10.4f} {100 * total(area, covered) / whole:10.2f} {L_MIN * total(area, flux) / whole:14.3f}")


def print_worst(texels, count=10):
    """Patches that are covered least, of these where least liquid arrives, as far apart as the program's own swabs.csv has them."""
    points = texels["Points"]
    places = list(zip(points[::3], points[1::3], points[2::3])) if not numpy else points.reshape(-1, 3).tolist()
    apart = 0.05 * math.dist(*(list(map(bound, zip(*places))) for bound in (min, max)))
    found = []
    for patch in sorted(range(len(places)), key=lambda i: (texels["covered"][i], texels["flux"][i], i)):
        if len(found) == count or texels["covered"][patch] == 1:
            break
        if all(math.dist(places[patch], places[other]) >= apart for other in found):
            found.append(patch)
    print(f"\n{'worst spots: part':<24} {'x m':>9} {'y m':>9} {'z m':>9} {'covered %':>10} {'flux L/min/m2':>14} {'speed m/s':>10}")
    for i in found:
        x, y, z = places[i]
        print(f"{texels['part_names'][texels['part'][i]]:<24} {x:9.3f} {y:9.3f} {z:9.3f} {100 * texels['covered'][i]:10.1f} "
              f"{L_MIN * texels['flux'][i]:14.3f} {texels['speed'][i]:10.2f}")


class Check:
    """Compares what files say with what result.json says, and notes what differs by more than single precision does."""

    def __init__(self):
        self.failed = False

    def __call__(self, what, found, told, tolerance=1e-5):
        agrees = abs(found - told) <= tolerance * max(abs(told), 1e-9)
        self.failed |= not agrees
        print(f"{what:<34} {found:14.7g} {told:14.7g} {'' if agrees else ' differs'}")


def check_all(folder, result, layout, texels):
    """True where all agrees."""
    check = Check()
    print(f"\n{'':<34} {'found':>14} {'result.json':>14}")
    whole, liquid = total(texels["area"]), L_MIN * total(texels["area"], texels["flux"])
    check("texels.vtp: area, m2", whole, result["geometry"]["clean_area_m2"])
    check("texels.vtp: covered area, m2", total(texels["area"], texels["covered"]), layout["covered_area_m2"])
    if "flux_l_min_m2" in layout:
        check("texels.vtp: mean flux, L/min/m2", liquid / whole, layout["flux_l_min_m2"]["mean"])
    surface = read_vtp(folder / "surface.vtp")
    counts = [area > 0 for area in surface["area"]]
    area, covered, flux = (chosen(surface[what], counts) for what in ("area", "covered", "flux"))
    check("surface.vtp: covered area, m2", total(area, covered), layout["covered_area_m2"])
    check("surface.vtp: liquid, L/min", L_MIN * total(area, flux), liquid)
    # An image has but one patch for each pixel: what shares it with a larger one is missing.
    images = read_exr(folder / "deposits.exr").values()
    channel = {name: [row for image in images for row in image[name]] for name in ("area", "covered")}
    seen = sum(map(total, channel["area"]))
    covered = sum(map(total, channel["area"], channel["covered"]))
    check("deposits.exr: area, m2", seen, whole, 0.01)
    check("deposits.exr: coverage", covered / seen if seen else 0, layout["coverage"], 0.01)
    return not check.failed


def main(folder):
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    layouts = {layout["name"]: layout for layout in result["layouts"]}
    layout = layouts[result.get("proposed", "proposed" if "proposed" in layouts else next(iter(layouts)))]
    print(f"{layout['name']}: {100 * layout['coverage']:.2f} % covered with {layout['water_l_min']:.1f} L/min\n")
    texels = read_vtp(folder / "texels.vtp")
    print_parts(texels)
    print_worst(texels)
    return 0 if check_all(folder, result, layout, texels) else 1


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
