"""The files for ParaView of real runs, against the table of io/vtk/README.md: paraview_files_test.py PROGRAMS SOURCE SCRATCH

One small robot walks in both models and is inflated. Its files must have points that are those at rest plus displacement_m, the same
box in both models at rest, an array of the cells to colour by, and the arrays that io/vtk/open_in_paraview.py has legends for."""

import array
import base64
import importlib.util
import os
import pathlib
import py_compile
import shutil
import struct
import subprocess
import sys
import unittest
import xml.etree.ElementTree
import zlib

PROGRAMS, SOURCE, SCRATCH = (pathlib.Path(name) for name in sys.argv[1:4])
SCRIPT = SOURCE / "io/vtk/open_in_paraview.py"
TYPES = {"Float64": "d", "Float32": "f", "Int32": "i", "UInt8": "B"}

# A hook over an empty first cell: a wrong origin does not go unnoticed.
ROBOT = """[robot]
layers = [["01"], ["11"]]
cell_edge_m = 0.01
wall_thickness_m = 0.002
silicone = "dragon_skin_10"
[drive]
pressure_Pa = [0, 4000]
frequency_Hz = 10
[walk]
duration_s = 0.2
fidelity = "draft"
"""


def numbers(element):
    """The numbers of a compressed array: in base64, the sizes of its blocks, then the blocks."""
    text = "".join(element.text.split())
    blocks, block_bytes, last_bytes = struct.unpack("<3I", base64.b64decode(text[:16]))
    header = 4 * (3 + blocks)
    header_text = 4 * ((header + 2) // 3)
    sizes = struct.unpack(f"<{3 + blocks}I", base64.b64decode(text[:header_text])[:header])[3:]
    data, begin = base64.b64decode(text[header_text:]), 0
    result = array.array(TYPES[element.get("type")])
    for size in sizes:
        result.frombytes(zlib.decompress(data[begin : begin + size]))
        begin += size
    return result


class Grid:
    """What a .vtu file holds."""

    def __init__(self, file):
        piece = xml.etree.ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
        self.points = numbers(piece.find("Points/DataArray"))
        self.cells = {each.get("Name"): each for each in piece.findall("CellData/DataArray")}
        self.point_data = {each.get("Name"): each for each in piece.findall("PointData/DataArray")}
        self.active_scalars = piece.find("CellData").get("Scalars")
        self.active_vectors = piece.find("PointData").get("Vectors")

    def rest(self):
        return [x - u for x, u in zip(self.points, numbers(self.point_data["displacement_m"]))]


def box(places):
    return [bound(places[axis::3]) for axis in range(3) for bound in (min, max)]


def entries(collection):
    return xml.etree.ElementTree.parse(collection).getroot().findall("Collection/DataSet")


def run(program, robot, folder):
    done = subprocess.run([PROGRAMS / program, robot, "-o", folder, "--no-pictures"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{program}: {done.stdout}")


class ParaViewFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        robot = SCRATCH / "robot.toml"
        robot.write_text(ROBOT, encoding="utf-8")
        cls.collections = {}
        for name, program, collection in (
            ("voxels", "menger-simulate", "frames.pvd"),
            ("elements", "menger-locomote", "frames.pvd"),
            ("inflation", "menger-inflate", "fields.pvd"),
        ):
            run(program, robot, SCRATCH / name)
            cls.collections[name] = SCRATCH / name / collection
        cls.grids = {
            name: [Grid(file.parent / entries(file)[place].get("file")) for place in (0, -1)] for name, file in cls.collections.items()
        }

    def test_points_less_displacements_are_those_at_rest(self):
        for name, (first, last) in self.grids.items():
            with self.subTest(name):
                self.assertEqual(len(first.points), len(last.points))
                rounding = 1e-8 if name == "voxels" else 1e-15  # float32 and float64
                for at_first, at_last in zip(first.rest(), last.rest()):
                    self.assertAlmostEqual(at_first, at_last, delta=rounding)
                self.assertGreater(max(abs(x - X) for x, X in zip(last.points, last.rest())), 1e-4, "it has not moved")
                self.assertEqual(last.active_vectors, "displacement_m")

    def test_both_models_begin_in_the_same_box(self):
        design = [0.0, 0.02, 0.0, 0.01, 0.0, 0.02]
        for name, (first, _) in self.grids.items():
            for places in (first.points, first.rest()):
                for expected, bound in zip(design, box(places)):
                    self.assertAlmostEqual(expected, bound, delta=1e-8, msg=name)

    def test_cells_have_one_array_to_colour_by(self):
        for name, scalars in (("voxels", "volume_ratio"), ("elements", "largest_stretch"), ("inflation", "largest_stretch")):
            for grid in self.grids[name]:
                self.assertEqual(grid.active_scalars, scalars, name)
                self.assertIn(scalars, grid.cells, name)

    def test_elements_have_the_state_that_they_are_in(self):
        for name in ("elements", "inflation"):
            first, last = self.grids[name]
            for array_name, at_rest in (("largest_stretch", 1.0), ("volume_ratio", 1.0), ("von_mises_stress_Pa", 0.0)):
                self.assertEqual(first.cells[array_name].get("type"), "Float32")
                for value in numbers(first.cells[array_name]):
                    self.assertAlmostEqual(value, at_rest, delta=1e-6)
            ratios = numbers(last.cells["volume_ratio"])
            self.assertTrue(0.9 < min(ratios) <= max(ratios) < 1.1, f"{name}: silicone keeps its volume")
            self.assertGreater(max(numbers(last.cells["largest_stretch"])), 1.02)
        self.assertGreater(max(numbers(self.grids["elements"][1].cells["chamber_pressure_Pa"])), 0.0)

    def test_parts_have_names(self):
        for name, part in (("voxels", "voxels"), ("elements", "finite elements"), ("inflation", "finite elements")):
            self.assertEqual({each.get("name") for each in entries(self.collections[name])}, {part})

    def test_script_is_python_and_names_arrays_that_are_there(self):
        py_compile.compile(SCRIPT, cfile=os.path.join(SCRATCH, "open_in_paraview.pyc"), doraise=True)
        spec = importlib.util.spec_from_file_location("open_in_paraview", SCRIPT)
        script = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(script)
        present = {array_name for grids in self.grids.values() for grid in grids for array_name in (*grid.cells, *grid.point_data)}
        present.add("mode")  # of menger modes
        self.assertEqual(set(script.LEGENDS) - present, set())
        self.assertEqual({*script.NEUTRAL, *script.WALK_ARRAYS} - set(script.LEGENDS), set())
        for grids in self.grids.values():
            self.assertIn(grids[0].active_scalars, script.LEGENDS)
        for name, part in (("voxels", "voxels"), ("elements", "finite elements")):
            self.assertEqual(script.part_names(script.found_file(SCRATCH / name)), [part])

    def test_script_says_what_is_wrong(self):
        for arguments, message in (
            ([SCRATCH], "holds none of frames.pvd, fields.pvd"),
            ([SCRATCH / "robot.toml"], "is neither .pvd nor .vtu nor .pvtu"),
        ):
            done = subprocess.run([sys.executable, "-S", "-B", SCRIPT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stdout)
        done = subprocess.run([sys.executable, "-S", "-B", SCRIPT, SCRATCH / "voxels"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("start it with pvpython", done.stdout, "where ParaView is not installed")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
