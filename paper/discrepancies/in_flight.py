#!/usr/bin/python3
"""What beams do to robots in flight, where nothing can turn them: without gravity, floor and drag, with the moments of the paper's simulator
and with moments that balance the forces of a beam.

in_flight.py scenes FOLDER   writes a scene of each of 100 random robots, those of walks/text.csv, with both moments
in_flight.py take FOLDER     makes in_flight.csv, in_flight_over_time.csv, in_flight_statistics.csv and in_flight.svg of what menger simulate
                             wrote for them

A robot that is driven in flight moves within its own stroke, and cannot turn: its energy of motion rises and falls with each stroke, and comes
back. Energy that is left over was made by the beams.

in_flight.csv             for each robot and both moments: how the simulation ended and when, the largest energy of motion in the last
                          stroke (J), and the energy that no work accounts for (J): energy of motion and of beams, less the work of the drive and of
                          damping
in_flight_over_time.csv   the energy of motion of the first robot (J) over time (s)
in_flight_statistics.csv  of robots of two materials and of one: how many spin up, which is that with the moments of the paper's simulator
                          they have twice the energy of motion or more; how many simulations end early, as a voxel moves faster than the
                          model bears; the energy that no work accounts for, over the energy of motion (median)
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys
from functools import cache

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np  # noqa: E402
from sample_statistics import median, share  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, toml_text, write_table, write_whole  # noqa: E402
from svg_figure import letter_panels, pyplot_for_svg, settle, write_svg  # noqa: E402

ROBOTS = 100
MOMENTS = {"published": "the paper's simulator", "balanced": "balanced beams"}
STYLES = {"published": ("#D55E00", "-"), "balanced": ("#0072B2", "--")}
PHYSICS = ("materials", "drive", "collisions", "limits", "integration", "damping")
FLIGHT = {"loads": {"gravity_m_per_s2": 0.0}, "ground": {"present": False}}
DURATION_S = 1.0  # five strokes
INTERVAL_S = 0.005
SPINS_UP = 2.0  # times the energy of motion with balanced moments


@cache
def preset():
    return read_toml(HERE.parent / "presets" / "paper.toml")


def scene(phenotype, moments):
    design = {"name": "robot", "cell_edge_m": preset()["body"]["cell_edge_m"], "cells": [3, 3, 3], "digits": phenotype}
    physics = {name: preset()[name] for name in PHYSICS} | FLIGHT
    physics["damping"] = physics["damping"] | {"global": 0.0}
    physics["materials"] = physics["materials"] | {"beam_moments": moments}
    time = {"duration_s": DURATION_S, "record_interval_s": INTERVAL_S}
    return toml_text({"energy_ledger": True, "design": design, "time": time, "output": {"frames": False, "pictures": False}} | physics)


def robots():
    return [(row["individual"], row["phenotype"]) for row in read_table(HERE / "walks" / "text.csv")[:ROBOTS]]


def scenes(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for individual, phenotype in robots():
        for moments in MOMENTS:
            write_whole(folder / f"{individual}-{moments}.toml", scene(phenotype, moments))


class Flight:
    """What was simulated of a robot."""

    def __init__(self, folder):
        result, rows = read_toml(folder / "result.toml"), read_table(folder / "trajectory.csv")
        self.status, self.time_s = result["status"], float(result["time_s"])
        self.times_s, self.kinetic_J, unaccounted_J = (np.array([float(row[name]) for row in rows]) for name in ("time_s", "kinetic_J", "energy_residual_J"))
        self.unaccounted_J = float(unaccounted_J[-1])

    def last_stroke_J(self):
        """The largest energy of motion in the last stroke."""
        stroke_s = 1.0 / preset()["drive"]["frequency_Hz"]
        return float(self.kinetic_J[self.times_s > self.times_s[-1] - stroke_s].max())


def statistics(rows):
    for materials, label in ((2, "two materials"), (1, "one material")):
        of_kind = [row for row in rows if row["materials"] == materials]
        if not of_kind:
            continue
        ratios = np.array([row["published_motion_J"] / row["balanced_motion_J"] for row in of_kind])
        row = {"materials": materials, "label": label, "robots": len(of_kind)} | share(int(np.sum(ratios >= SPINS_UP)), len(of_kind)).cells("spin_up")
        for moments in MOMENTS:
            row |= {f"{moments}_end_early": sum(one[f"{moments}_status"] != "completed" for one in of_kind)}
            row |= {f"{moments}_unaccounted": float(np.median([abs(one[f"{moments}_unaccounted_J"]) / one[f"{moments}_motion_J"] for one in of_kind]))}
        yield row | median(ratios).cells("ratio") | {"ratio_largest": float(ratios.max())}


def draw(over_time, rows):
    """The energy of motion of one robot over time, and of all robots at the end."""
    pyplot = pyplot_for_svg()
    pyplot.rcParams |= {"font.size": 8, "legend.fontsize": 7.5}
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(6.5, 3.4), layout="constrained")
    for moments, (colour, dashes) in STYLES.items():
        curve = [(row["time_s"], row[f"{moments}_J"]) for row in over_time if row[f"{moments}_J"]]
        left.plot(*zip(*curve), linestyle=dashes, color=colour, linewidth=1.2, label=MOMENTS[moments])
    left.set(yscale="log", xlabel="time (s)", ylabel="energy of motion (J)")
    left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2))
    styles = {(2, True): ("#D55E00", "^", "two materials, ended early"), (2, False): ("#E69F00", "o", "two materials"), (1, False): ("#0072B2", "s", "one material")}
    for (materials, early), (colour, mark, label) in styles.items():
        of_kind = [row for row in rows if row["materials"] == materials and (row["published_status"] != "completed") == early]
        if of_kind:
            right.scatter([row["balanced_motion_J"] for row in of_kind], [row["published_motion_J"] for row in of_kind], c=colour, marker=mark, s=12, label=f"{label} (n = {len(of_kind)})")
    ends = [min(row["balanced_motion_J"] for row in rows) / 2, max(row["balanced_motion_J"] for row in rows) * 2]
    right.plot(ends, ends, color="#222222", linewidth=1, label="as much")
    right.set(xscale="log", yscale="log", xlabel="balanced beams (J)", ylabel="the paper's simulator (J)")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2))
    letter_panels([(left, "energy of motion of a robot"), (right, "of every robot, in the last stroke")])
    settle(figure)
    write_svg(figure, HERE / "in_flight.svg")


def take(folder):
    rows, over_time = [], []
    for individual, phenotype in robots():
        folders = {moments: folder / f"{individual}-{moments}" for moments in MOMENTS}
        if not all((one / "result.toml").exists() for one in folders.values()):
            continue
        flights = {moments: Flight(one) for moments, one in folders.items()}
        row = {"individual": individual, "phenotype": phenotype, "materials": len(set(phenotype) - {"0"})}
        for moments, flight in flights.items():
            row |= {f"{moments}_status": flight.status, f"{moments}_time_s": flight.time_s, f"{moments}_motion_J": flight.last_stroke_J(),
                    f"{moments}_unaccounted_J": flight.unaccounted_J}
        if not rows:
            longest = max(flights.values(), key=lambda flight: len(flight.times_s))
            over_time = [{"time_s": float(time_s)} | {f"{moments}_J": float(flight.kinetic_J[place]) if place < len(flight.kinetic_J) else None
                                                     for moments, flight in flights.items()} for place, time_s in enumerate(longest.times_s)]
        rows.append(row)
    if not rows:
        raise InputError(f"{folder}: has no simulated robot")
    for name, made in (("in_flight", rows), ("in_flight_over_time", over_time), ("in_flight_statistics", list(statistics(rows)))):
        write_table(HERE / f"{name}.csv", list(made[0]), [{key: cell(value) for key, value in row.items()} for row in made])
    draw(over_time, rows)


def main(arguments):
    match arguments:
        case ["scenes", folder]:
            scenes(pathlib.Path(folder))
        case ["take", folder]:
            take(pathlib.Path(folder))
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
