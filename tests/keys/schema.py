#!/usr/bin/env python3
"""The program's JSON Schemas, by an independent validator: they take what the program takes and
writes, and refuse what it refuses.

    schema.py SPRAYPLAN SOURCE_FOLDER

Exit status 77, skipped, without Debian's python3-jsonschema and python3-yaml."""
import copy
import glob
import json
import subprocess
import sys

try:
    import jsonschema
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

program, source = sys.argv[1:]


def schema_of(topic):
    text = subprocess.run([program, "help", topic, "--schema"], check=True, capture_output=True, text=True).stdout
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def load(path):
    with open(path, encoding="utf-8") as file:
        return yaml.safe_load(file)


scene, catalogue = schema_of("scene"), schema_of("catalogue")
samples = sorted(glob.glob(f"{source}/scenes/*.yaml")) + sorted(glob.glob(f"{source}/tests/keys/every_key/*.yaml"))
taken = 0
for path in samples:
    tree = load(path)
    schema = scene if "geometry" in tree else catalogue
    for error in schema.iter_errors(tree):
        sys.exit(f"{path}: {list(error.absolute_path)}: {error.message[:300]}")
    taken += 1
assert taken >= 15, taken

whole, types = load(f"{source}/tests/keys/every_key/scene.yaml"), load(f"{source}/tests/keys/every_key/catalogue.yaml")


def refused(schema, tree, change):
    slip = copy.deepcopy(tree)
    change(slip)
    return not schema.is_valid(slip)


slips = [
    (scene, whole, lambda t: t.pop("geometry")),
    (scene, whole, lambda t: t.update(gravitiy="9.8 m/s2")),
    (scene, whole, lambda t: t.update(gravity=9.8)),
    (scene, whole, lambda t: t.update(up="x")),
    (scene, whole, lambda t: t.update(cavity=[0, 1])),
    (scene, whole, lambda t: t.update(cavity="inside")),
    (scene, whole, lambda t: t["simulate"].update(reflections="many")),
    (scene, whole, lambda t: t["simulate"].update(jets=0)),
    (scene, whole, lambda t: t["place"]["mounts"][0].update(line={"from": [0, 0, 0], "to": [0, 0, 0]})),
    (scene, whole, lambda t: t["place"]["mounts"][0]["port"].pop("position")),
    (scene, whole, lambda t: t["place"].update(refine="all")),
    (scene, whole, lambda t: t["nozzles"][0].update(pressure="two bar")),
    (catalogue, types, lambda t: t["nozzles"][0].update(pattern="cone")),
    (catalogue, types, lambda t: t["nozzles"][0].update(angle_range=["60 deg"])),
    (catalogue, types, lambda t: t["nozzles"][1].update(flow=[8, 16])),
    (catalogue, types, lambda t: t["nozzles"][5]["rotation"].update(gears=[43, 47.5])),
]
for number, (schema, tree, change) in enumerate(slips):
    assert refused(schema, tree, change), f"slip {number} is taken"

result = schema_of("result")
placed = subprocess.run([program, "place", f"{source}/tests/cli/readme/vessel.yaml", "--json", "--quiet"], check=True,
                        capture_output=True, text=True).stdout
results = [json.loads(placed)] + [load(path) for path in sorted(glob.glob(f"{source}/tests/cli/golden/*.json"))]
for number, tree in enumerate(results):
    for error in result.iter_errors(tree):
        sys.exit(f"result {number}: {list(error.absolute_path)}: {error.message[:300]}")
assert refused(result, results[0], lambda t: t["geometry"].update(triangles=-1))
print(f"{taken} files and {len(results)} results taken, {len(slips)} slips refused")
