#!/usr/bin/env pvpython
"""Opens a run of menger in ParaView as a person wants to see it: coloured, on its ground, with its clock.

    pvpython open_in_paraview.py RUN [--picture FILE.png] [--state FILE.pvsm] [--colour ARRAY] [--time T] [--cut] [--overlay]

RUN is a collection (.pvd), one file of it (.vtu, .pvtu), or the folder of a run. A picture is of the last time, or of the one
nearest to T. A state file opens in ParaView with everything that this script arranges: `paraview FILE.pvsm`. Without either, a
window opens. Where a collection has two models of one body, they stand beside each other; --overlay leaves both at their place,
finite elements transparent. --cut removes the half in front, so that chambers are seen. ARRAY is one of the cells (or of the points),
instead of the one that the file names; `displacement_m` is shown by its length.
Exit codes: 0 done, 2 wrong input.
"""

import argparse
import math
import pathlib
import sys
import xml.etree.ElementTree

# Names of a run's collections, the first that is there is opened.
COLLECTIONS = ("frames.pvd", "fields.pvd", "both.pvd", "winner/both.pvd", "worst.pvd")

# Arrays that files have (see README.md) and what a legend calls them.
LEGENDS = {
    "largest_stretch": "largest principal stretch",
    "von_mises_stress_Pa": "von Mises stress (Pa)",
    "volume_ratio": "volume over that at rest",
    "chamber_pressure_Pa": "chamber pressure (Pa)",
    "strain": "strain",
    "phase": "phase of the drive (periods)",
    "material": "material",
    "size_m": "driven size (m)",
    "speed_m_s": "speed (m/s)",
    "displacement_m": "displacement (m)",
    "velocity_m_per_s": "speed (m/s)",
    "mode": "mode of vibration",
}
# Where these are, something walks: its clock is in seconds, and it is shown on its ground.
WALK_ARRAYS = ("velocity_m_per_s", "speed_m_s")
# Values that mean "nothing has happened". Colours begin there, or are as far on both sides.
NEUTRAL = {
    "largest_stretch": 1.0,
    "von_mises_stress_Pa": 0.0,
    "volume_ratio": 1.0,
    "strain": 0.0,
    "displacement_m": 0.0,
    "speed_m_s": 0.0,
    "velocity_m_per_s": 0.0,
    "mode": 0.0,
}

MOST_SAMPLES = 25  # times at which ranges and bounds are looked up
TO_EYE = (0.55, -1.0, 0.6)
SIZE_PX = (1600, 900)


class WrongInput(Exception):
    """Something that a person has to change, in one sentence."""


def arguments():
    parser = argparse.ArgumentParser(prog="open_in_paraview.py", description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="collection (.pvd), .vtu, or folder of a run")
    parser.add_argument("--picture", type=pathlib.Path, help="write a picture (.png)")
    parser.add_argument("--state", type=pathlib.Path, help="write a state file (.pvsm) that ParaView opens")
    parser.add_argument("--colour", help="array to colour by")
    parser.add_argument("--time", type=float, help="time of the picture (default: the last)")
    parser.add_argument("--cut", action="store_true", help="remove the half in front")
    parser.add_argument("--overlay", action="store_true", help="leave two models at one place")
    return parser.parse_args()


def found_file(run):
    """The file to open: the one named, or the first collection of a folder."""
    if run.is_file():
        if run.suffix not in (".pvd", ".vtu", ".pvtu"):
            raise WrongInput(f"{run}: is neither .pvd nor .vtu nor .pvtu")
        return run
    for name in COLLECTIONS:
        if (run / name).is_file():
            return run / name
    raise WrongInput(f"{run}: holds none of {', '.join(COLLECTIONS)}")


def part_names(file):
    """The names of the parts of a collection, in order; of another file, one name."""
    if file.suffix != ".pvd":
        return ["body"]
    try:
        sets = xml.etree.ElementTree.parse(file).getroot().findall("Collection/DataSet")
    except xml.etree.ElementTree.ParseError as error:
        raise WrongInput(f"{file}: is no collection: {error}") from error
    names = {int(each.get("part", "0")): each.get("name", "") for each in sets}
    if not names:
        raise WrongInput(f"{file}: names no files")
    return [name or f"part {part}" for part, name in sorted(names.items())]


def samples(times):
    """At most MOST_SAMPLES of some times, with the first and the last."""
    if len(times) <= MOST_SAMPLES:
        return list(times)
    return [times[n * (len(times) - 1) // (MOST_SAMPLES - 1)] for n in range(MOST_SAMPLES)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


class Box:
    """The smallest box around boxes (low x, high x, low y, ...)."""

    def __init__(self):
        self.low = [math.inf] * 3
        self.high = [-math.inf] * 3

    def add(self, bounds):
        for axis in range(3):
            self.low[axis] = min(self.low[axis], bounds[2 * axis])
            self.high[axis] = max(self.high[axis], bounds[2 * axis + 1])

    def size(self, axis):
        return self.high[axis] - self.low[axis]

    def corners(self):
        return [(x, y, z) for x in (self.low[0], self.high[0]) for y in (self.low[1], self.high[1]) for z in (self.low[2], self.high[2])]


class Part:
    """One body of a scene: what it is coloured by, its range of colours, and the space that it takes in all its time."""

    def __init__(self, name, source, times, colour):
        from paraview import servermanager
        from vtkmodules.util.numpy_support import vtk_to_numpy
        import numpy

        self.name = name
        self.source = source
        self.first = Box()
        self.whole = Box()
        self.colour = colour
        self.is_of_cells = True
        self.walks = False
        values = []
        for time in samples(times):
            source.UpdatePipeline(time)
            grid = servermanager.Fetch(source)
            if grid.IsA("vtkCompositeDataSet"):
                grid = next((block for block in leaves(grid)), None)
            if grid is None or grid.GetNumberOfPoints() == 0:
                continue
            if self.first.low[0] == math.inf:
                self.first.add(grid.GetBounds())
                self.choose_colour(grid)
            self.whole.add(grid.GetBounds())
            array = (grid.GetCellData() if self.is_of_cells else grid.GetPointData()).GetArray(self.colour) if self.colour else None
            if array is not None:
                numbers = vtk_to_numpy(array)
                numbers = numpy.linalg.norm(numbers, axis=1) if numbers.ndim > 1 else numbers
                numbers = numbers[numpy.isfinite(numbers)]
                if len(numbers):
                    # A few elements at inner edges have far more than all others; values of points are smooth.
                    values.append(numpy.percentile(numbers, [1, 99] if self.is_of_cells else [0, 100]))
        if self.first.low[0] == math.inf:
            raise WrongInput(f"{name}: no file of it can be read")
        self.is_two_sided = False
        self.range = self.range_of(min(v[0] for v in values), max(v[1] for v in values)) if values else (0.0, 1.0)

    def choose_colour(self, grid):
        cells, points = grid.GetCellData(), grid.GetPointData()
        self.walks = any(data.HasArray(name) for data in (cells, points) for name in WALK_ARRAYS)
        if self.colour is None:
            if cells.GetScalars() is not None:
                self.colour = cells.GetScalars().GetName()
            elif points.HasArray("displacement_m"):
                self.colour = "displacement_m"
        self.is_of_cells = self.colour is not None and bool(cells.HasArray(self.colour))
        if self.colour is not None and not self.is_of_cells and not points.HasArray(self.colour):
            names = [data.GetArrayName(n) for data in (cells, points) for n in range(data.GetNumberOfArrays())]
            raise WrongInput(f"{self.name} has no array {self.colour}; it has {', '.join(names)}")

    def range_of(self, low, high):
        neutral = NEUTRAL.get(self.colour, low)
        below, above = neutral - low, high - neutral
        self.is_two_sided = below > 0.1 * max(above, 0.0)
        if self.is_two_sided:
            half = max(below, above)
            return neutral - half, neutral + half
        low = min(low, neutral)
        return (low, high) if high > low else (low, low + (abs(low) or 1.0))


def leaves(composite):
    iterator = composite.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def show(part, view, pipeline, is_only, opacity, place):
    """Shows the end of a part's pipeline, with its legend."""
    from paraview import simple

    display = simple.Show(pipeline, view)
    display.Representation = "Surface With Edges"
    display.EdgeColor = [0.25, 0.25, 0.25]
    display.LineWidth = 0.5
    display.Opacity = opacity
    display.Ambient, display.Diffuse = 0.3, 0.75
    if part.colour is None:
        display.ColorArrayName = ["POINTS", ""]
        return
    simple.ColorBy(display, ("CELLS" if part.is_of_cells else "POINTS", part.colour), separate=True)
    colours = simple.GetColorTransferFunction(part.colour, display, separate=True)
    colours.ApplyPreset("Cool to Warm" if part.is_two_sided else "Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(*part.range)
    colours.AutomaticRescaleRangeMode = "Never"
    legend = simple.GetScalarBar(colours, view)
    title = LEGENDS.get(part.colour, part.colour)
    legend.Title = title if is_only else f"{part.name}: {title}"
    legend.ComponentTitle = ""
    legend.TitleColor = legend.LabelColor = [0.1, 0.1, 0.1]
    legend.TitleFontSize = 18
    legend.LabelFontSize = 16
    legend.ScalarBarLength = 0.3
    legend.ScalarBarThickness = 16
    legend.Orientation = "Horizontal"
    legend.AutomaticLabelFormat = 0
    step = (part.range[1] - part.range[0]) / 4
    digits = 2 + max(1, math.ceil(math.log10(max(map(abs, part.range)) / step)))  # so that no two labels read alike
    legend.LabelFormat = f"%.{digits}g"
    legend.AddRangeLabels = 0
    legend.UseCustomLabels = 1
    legend.CustomLabels = [part.range[0] + step * n for n in range(5)]
    legend.WindowLocation = "Any Location"
    legend.Position = [0.15 + 0.42 * place, 0.05]  # right of the axes
    legend.Visibility = 1
    display.SetScalarBarVisibility(view, True)


def add_ground(view, box, height):
    """Shows the ground around a box. Returns its corners."""
    from paraview import simple

    margin = 0.2 * max(box.size(0), box.size(1))
    x, y = (box.low[0] - margin, box.high[0] + margin), (box.low[1] - margin, box.high[1] + margin)
    height -= 1e-3 * max(box.size(0), box.size(1))  # below the feet, so that none of them shine through
    plane = simple.Plane(registrationName="ground", Origin=[x[0], y[0], height], Point1=[x[1], y[0], height], Point2=[x[0], y[1], height])
    edge = max(box.size(2), 1e-6) / 2.0
    plane.XResolution, plane.YResolution = (max(1, min(100, round((to - at) / edge))) for at, to in (x, y))
    display = simple.Show(plane, view)
    display.Representation = "Surface With Edges"
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = [0.88, 0.88, 0.86]
    display.EdgeColor = [0.72, 0.72, 0.70]
    display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0  # of one colour, whatever the light
    return [(at_x, at_y, height) for at_x in x for at_y in y]


def aim(view, points):
    """Looks from the side of small y, from above, so that points fill the picture above the legends."""
    eye = unit(TO_EYE)
    right = unit((-eye[1], eye[0], 0.0))
    up = (eye[1] * right[2] - eye[2] * right[1], eye[2] * right[0] - eye[0] * right[2], eye[0] * right[1] - eye[1] * right[0])
    across = [dot(point, right) for point in points]
    upward = [dot(point, up) for point in points]
    depth = [dot(point, eye) for point in points]
    free = 0.80  # of the height; the rest is for the legends
    height = max((max(upward) - min(upward)) / free, (max(across) - min(across)) * SIZE_PX[1] / SIZE_PX[0]) * 1.06
    middle = [0.5 * (max(values) + min(values)) for values in (across, upward, depth)]
    middle[1] -= 0.5 * (1.0 - free) * height * 0.8
    focus = [middle[0] * right[i] + middle[1] * up[i] + middle[2] * eye[i] for i in range(3)]
    distance = 4.0 * max(height, max(depth) - min(depth))
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = focus
    view.CameraPosition = [focus[i] + distance * eye[i] for i in range(3)]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraParallelScale = 0.5 * height
    view.CenterOfRotation = focus


def make_view():
    from paraview import simple

    view = simple.CreateView("RenderView")
    view.ViewSize = list(SIZE_PX)
    view.UseColorPaletteForBackground = 0
    view.UseFXAA = 1
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = [0.1, 0.1, 0.1]
    return view


def add_clock(view, source, words):
    from paraview import simple

    clock = simple.AnnotateTimeFilter(registrationName="clock", Input=source)
    clock.Format = words
    display = simple.Show(clock, view)
    display.Color = [0.1, 0.1, 0.1]
    display.FontSize = 20
    display.WindowLocation = "Upper Left Corner"


def reader_of(file):
    from paraview import simple

    kinds = {".pvd": simple.PVDReader, ".vtu": simple.XMLUnstructuredGridReader, ".pvtu": simple.XMLPartitionedUnstructuredGridReader}
    name = [str(file.resolve())] if file.suffix != ".pvd" else str(file.resolve())
    return kinds[file.suffix](registrationName=file.name, FileName=name)


def clock_words(file, walks):
    if walks:
        return "t = {time:.3f} s"
    counts_states = file.name == "worst.pvd" or (file.parent / "content_hash").is_file()  # the latter of load cases
    return "state {time:.0f}" if counts_states else "path parameter {time:.3g}"


def arrange(file, options):
    """Makes the whole scene. Returns the view and the times."""
    from paraview import simple

    simple._DisableFirstRenderCameraReset()
    reader = reader_of(file)
    times = list(reader.TimestepValues) if hasattr(reader, "TimestepValues") and len(reader.TimestepValues) else [0.0]
    names = part_names(file)
    view = make_view()
    parts = []
    for number, name in enumerate(names):
        source = reader
        if len(names) > 1:
            source = simple.ExtractBlock(registrationName=name, Input=reader)
            source.Selectors = [f"/Root/{block_name(reader, number)}"]
        parts.append(Part(name, source, times, options.colour))
    scene_box = Box()
    for number, part in enumerate(parts):
        end = part.source
        shift = 0.0
        if number > 0 and not options.overlay:
            shift = parts[0].whole.low[1] - part.whole.high[1] - parts[0].first.size(1)
            end = simple.Transform(registrationName=f"{part.name}, aside", Input=end)
            end.Transform.Translate = [0.0, shift, 0.0]
        if options.cut:
            end = simple.Clip(registrationName=f"{part.name}, cut", Input=end)
            end.ClipType.Origin = [0.0, 0.5 * (part.first.low[1] + part.first.high[1]) + shift, 0.0]
            end.ClipType.Normal = [0.0, -1.0, 0.0]
        opacity = 0.45 if options.overlay and number == 0 and len(parts) > 1 else 1.0
        show(part, view, end, len(parts) == 1, opacity, number)
        box = part.whole
        scene_box.add((box.low[0], box.high[0], box.low[1] + shift, box.high[1] + shift, box.low[2], box.high[2]))
    walks = any(part.walks for part in parts)
    seen = scene_box.corners()
    if walks:
        seen += add_ground(view, scene_box, min(part.first.low[2] for part in parts))
    if len(times) > 1:
        add_clock(view, reader, clock_words(file, walks))
    animation = simple.GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    animation.PlayMode = "Snap To TimeSteps"
    wanted = times[-1] if options.time is None else min(times, key=lambda time: abs(time - options.time))
    animation.AnimationTime = wanted
    view.ViewTime = wanted
    aim(view, seen)
    simple.Render(view)
    return view


def block_name(reader, number):
    """The name of a block in selectors."""
    from paraview import servermanager

    reader.UpdatePipeline()
    assembly = reader.GetDataInformation().DataInformation.GetHierarchy()
    return assembly.GetNodeName(assembly.GetChildNodes(assembly.GetRootNode(), False)[number])


def main():
    options = arguments()
    try:
        file = found_file(options.run)
        part_names(file)  # before ParaView starts
        from paraview import simple

        view = arrange(file, options)
        if options.picture:
            simple.SaveScreenshot(str(options.picture), view, ImageResolution=list(SIZE_PX))
        if options.state:
            simple.SaveState(str(options.state))
        if not options.picture and not options.state:
            simple.Interact(view)
        simple.Disconnect()  # or else the view outlives its display, which ends the program with an error
    except WrongInput as error:
        print(f"open_in_paraview.py: {error}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"open_in_paraview.py: {error}: start it with pvpython or pvbatch, which come with ParaView", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
