#!/usr/bin/python3
"""strokes.py STALL_MAP TABLE.csv: what the marked points of a stall map take from the piston, at any tube of the map.

Reads stall_map.csv and isobars.csv in the folder of the map. The narrowest tube is the last in which some stroke reaches the
pressure: its diameter is empty if that is the narrowest of the map.
"""

import csv
import pathlib
import sys


def rows_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def main(folder, table):
    diameters_m = {row["resistance_Pa_s_per_m3"]: row["diameter_m"] for row in rows_of(folder / "stall_map.csv")}
    marks = {}
    for row in rows_of(folder / "isobars.csv"):
        if row["label"]:
            marks.setdefault((row["label"], row["measure"], row["frequency_Hz"], row["pressure_Pa"]), []).append(row)
    with open(table, "w", newline="", encoding="utf-8") as text:
        out = csv.writer(text, lineterminator="\n")
        out.writerow(["mark", "measure", "frequency_Hz", "pressure_Pa", "least_swept_volume_m3", "most_swept_volume_m3", "narrowest_diameter_m"])
        for mark, points in marks.items():
            reached = [row for row in points if row["swept_volume_m3"]]
            volumes = sorted((row["swept_volume_m3"] for row in reached), key=float)
            narrowest = "" if len(reached) == len(points) else diameters_m[reached[-1]["resistance_Pa_s_per_m3"]]
            out.writerow([*mark, volumes[0], volumes[-1], narrowest])


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2])
