"""Opens pages of menger report in a headless Chromium: report_page.py MENGER_REPORT SCRATCH [PAGE ...]

Makes a small folder of results, whose names try to be markup, lets menger report make its page, and looks at it: no errors and no
network, the canvas is not blank, the slider, the keys and Play move the bodies, nothing is wider than a phone. Further pages are
checked in the same way. Leaves with 77, which ctest takes for skipped, where there is no Chromium or no three.js."""

import os
import shutil
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from headless_browser import Browser, find_browser, pixels  # noqa: E402

SKIPPED = 77
HOSTILE = "</script><script>window.harmed=1</script><img src=x onerror='window.harmed=2'>"


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def grid(x, pressure_Pa):
    """A cube of 1 cm at x (m), and a smaller one on it, at one pressure."""
    points, corners = "", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    for size, z in ((0.01, 0.0), (0.006, 0.01)):
        points += "\n".join(f"{x + size * a} {size * b} {z + size * c}" for a, b, c in corners) + "\n"
    return f"""<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>
<FieldData><DataArray type="Float64" Name="pressure_Pa" NumberOfTuples="1" format="ascii">{pressure_Pa}</DataArray></FieldData><Piece NumberOfPoints="16" NumberOfCells="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">{' '.join(map(str, range(16)))}</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">8 16</DataArray><DataArray type="UInt8" Name="types" format="ascii">12 12</DataArray></Cells>
<CellData><DataArray type="UInt8" Name="material" format="ascii">1 2</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>"""


def write_walk(folder, program, speed, lines):
    """A walk of 2 s with 5 frames, and a table of so many lines."""
    json_name = HOSTILE.replace('"', '\\"')
    write(folder + "/manifest.json", f'{{"program": "{program}", "version": "0.1.0", "seconds": 1, "inputs_sha256": {{"{json_name}": "00"}}, "parameters": '
          f'{{"design": {{"name": "{json_name}", "cell_edge_m": 0.01, "layers": [["1"], ["2"]]}}, "drive": {{"mode": "phases"}}}}}}')
    result = "locomotion.toml" if program == "menger-locomote" else "result.toml"
    write(f"{folder}/{result}", f'status = "completed"\ntime_s = 2\ndisplacement_m = [{2 * speed}, 0, 0]\nhorizontal_displacement_m = {2 * speed}\n'
          f'horizontal_displacement_body_lengths = {200 * speed}\n')
    rows, files = "", ""
    for n in range(5):
        time_s = 0.5 * n
        write(f"{folder}/frames/frame_{n}.vtu", grid(speed * time_s, 3000 * (n % 2)))  # full strokes at 0.5 s and 1.5 s
        files += f'<DataSet timestep="{time_s}" part="0" file="frames/frame_{n}.vtu"/>'
    for n in range(lines):
        time_s = 2 * n / (lines - 1)
        rows += f"{time_s},{speed * time_s},0,0.005,{speed * time_s}\n"
    write(folder + "/trajectory.csv", "time_s,centre_of_mass_x_m,centre_of_mass_y_m,centre_of_mass_z_m,horizontal_displacement_m\n" + rows)
    write(folder + "/frames.pvd", f'<VTKFile type="Collection" version="0.1"><Collection>{files}</Collection></VTKFile>')


def colours(png):
    """The colours of a picture with how often they occur."""
    _, _, channels, rows = pixels(png)
    counts = {}
    for row in rows:
        for at in range(0, len(row), channels):
            colour = row[at:at + 3]
            counts[colour] = counts.get(colour, 0) + 1
    return counts


def difference(a, b):
    """The number of pixels that differ between two pictures of one size."""
    wide, high, channels, rows_a = pixels(a)
    other = pixels(b)
    assert (wide, high, channels) == other[:3]
    return sum(row_a[at:at + 3] != row_b[at:at + 3] for row_a, row_b in zip(rows_a, other[3]) for at in range(0, len(row_a), channels))


class Check:
    def __init__(self):
        self.failed = 0

    def that(self, holds, claim):
        print(("ok      " if holds else "FAILED  ") + claim, flush=True)
        self.failed += not holds


def check_motion(browser, check, name):
    """The canvas, the slider, the keys and Play."""
    browser.value("document.getElementById('motion').scrollIntoView()")
    browser.settle()
    stage = browser.box(".stage")
    browser.value("document.getElementById('time').focus()")
    browser.key("Home")
    browser.settle()
    first = browser.picture(clip=stage)
    counts = colours(first)
    shaded = sum(count for colour, count in counts.items() if count < max(counts.values()))
    check.that(len(counts) > 20 and shaded > 0.02 * sum(counts.values()), f"{name}: the canvas is not blank ({len(counts)} colours)")
    before = browser.value("document.getElementById('scene-time').textContent")
    browser.key("End")
    browser.settle()
    last = browser.picture(clip=stage)
    after = browser.value("document.getElementById('scene-time').textContent")
    check.that(difference(first, last) > 200, f"{name}: the slider moves the bodies ({difference(first, last)} pixels differ)")
    check.that(before != after, f"{name}: the time is shown ({before!r}, then {after!r})")
    browser.key("Home")
    browser.settle()
    check.that(difference(first, browser.picture(clip=stage)) < 50, f"{name}: the slider brings them back")
    browser.value("document.getElementById('scene').focus()")
    browser.key("ArrowRight", count=5)
    browser.settle()
    check.that(difference(first, browser.picture(clip=stage)) > 200, f"{name}: arrow keys turn the view")
    browser.value("document.getElementById('play').focus()")
    browser.key("Enter")
    if browser.value("document.getElementById('play').textContent") != "Pause":
        browser.value("document.getElementById('play').click()")
    position = browser.value("document.getElementById('time').value")
    end = time.monotonic() + 20
    while browser.value("document.getElementById('time').value") == position and time.monotonic() < end:
        time.sleep(0.05)
    check.that(browser.value("document.getElementById('time').value") != position, f"{name}: Play moves the slider")
    browser.value("document.getElementById('play').click()")


def check_first_view(browser, check):
    """The view opens at the last full stroke, and colours show no way travelled. The page has been opened at its start."""
    time = browser.value("document.getElementById('scene-time').textContent")
    check.that("time 1.500 s" in time and "pressure 3.00 kPa" in time, f"the view opens at a full stroke: {time!r}")
    browser.value("(() => { const choice = [...document.querySelectorAll('.controls select')].find(s => [...s.options].some(o => o.value === 'displacement'));"
                  " choice.value = 'displacement'; choice.dispatchEvent(new Event('change')); })()")
    browser.settle()
    largest = browser.value("document.querySelector('.bar').lastChild.textContent")
    check.that(float(largest.split()[0]) < 1, f"a body that travels without a change of shape is displaced by nothing: {largest!r}")


def check_ends(browser, check):
    """Beside a longer walk, one that has ended says so. The page has been opened."""
    told = browser.value("[1, 2.01, 4].map(time => Body.prototype.ended.call({times: [0, 2]}, time, 's'))")
    check.that(told == ["", "", " (ended at 2 s)"], f"a walk beside a longer one tells when it ended: {told}")


def check_chambers(browser, check):
    """Pressures are told with the material of their chambers, and materials have one colour in 3-D and in charts. The page has been opened."""
    told = browser.value("Object.assign(Object.create(Body.prototype), {times: [0, 1], pressures: [[1000, 2000], [500, 0], [500, 0]], chambers: [0, 1, 2, 0], materials: [2, 1, 1, 2]})"
                         ".pressureText(1)")
    check.that(told == "pressure 0.00 kPa in material 1, 2.00 kPa in material 2", f"pressures have the material of their chamber: {told!r}")
    drawn = browser.value("[1, 2].map(m => [materialColour(m).map(c => Math.round(255 * c)), seriesColour(5, {material: m}), seriesColour(5, {})])")
    check.that(drawn == [[[0, 114, 178], "var(--m1)", "var(--c5)"], [[213, 94, 0], "var(--m2)", "var(--c5)"]], f"materials have one colour: {drawn}")


def check_narrow_table(browser, check):
    """On a phone, a table of long texts has rows of few lines, and is scrolled in one direction only. The page has been opened."""
    browser.resize(390, 844)
    rows = ", ".join("['speed lost if finite elements judge only the best 1 (body lengths / min)', 'completed', '0.2065', '1', '1', '2', '3']" for _ in range(11))
    browser.value("drawTable({title: 'narrow', note: '', columns: ['quantity', 'status', 'search (draft finite elements): speed (body lengths / min)', 'a', 'b', 'c', 'd'], "
                  f"rows: [{rows}]}}, document.getElementById('sections'))")
    browser.settle()
    lines = browser.value("(() => { const table = [...document.querySelectorAll('.table')].pop(), height = (row) => row.getBoundingClientRect().height / parseFloat(getComputedStyle(row).fontSize);"
                          " return [...table.querySelectorAll('tr')].map(height).concat([table.scrollHeight - table.clientHeight]); })()")
    check.that(lines[0] < 9 and max(lines[1:-1]) < 7, f"a narrow screen has rows of few lines (heights {lines[0]:.1f} and {max(lines[1:-1]):.1f} em)")
    check.that(lines[-1] <= 1, f"a narrow screen scrolls a table in one direction ({lines[-1]} pixels hidden below)")
    wide = browser.value("document.documentElement.scrollWidth")
    check.that(wide <= 390, f"a table is no wider than its screen ({wide})")


def check_page(browser, check, page, name):
    for scheme in ("light", "dark"):
        browser.prefer(scheme)
        for width, height in ((1400, 1000), (390, 844)):
            browser.resize(width, height)
            browser.open(page)
            browser.settle()
            wide = browser.value("document.documentElement.scrollWidth")
            check.that(wide <= width, f"{name}: {scheme}, {width} pixels: nothing is wider than the screen ({wide})")
            check.that(browser.value("document.querySelectorAll('figure > svg').length > 0 && [...document.querySelectorAll('figure > svg')].every(s => s.children.length > 3)"),
                       f"{name}: {scheme}, {width} pixels: charts are drawn")
    browser.prefer("light")
    browser.resize(1400, 1000)
    browser.open(page)
    unnamed = browser.value("[...document.querySelectorAll('button,select,input,canvas')].filter(e => !e.hidden && !(e.labels && e.labels.length) && !e.textContent && !e.getAttribute('aria-label')).length")
    check.that(unnamed == 0, f"{name}: every control has a name ({unnamed} have none)")
    outline = browser.value("(() => { document.getElementById('play').focus({focusVisible: true}); return getComputedStyle(document.getElementById('play')).outlineStyle; })()")
    check.that(outline == "solid", f"{name}: the focus is visible")
    check_motion(browser, check, name)


def check_bad_chart(browser, check):
    """A chart that cannot be drawn leaves its neighbours as they are. The page has been opened."""
    bad, good = '{title: "bad"}', ('{title: "good", x: {title: "x", log: false}, y: {title: "y", log: false}, markers: [], equal: false, diagonal: false, note: "", '
                                   'series: [{name: "s", x: [0, 1], y: [0, 1], marks: "line", dashed: false, labels: []}]}')
    late = good.replace('"good"', '"late"').replace("x: [0, 1]", "x: null")
    browser.value(f'drawSection({{id: "tried", title: "tried", words: [], tables: [], charts: [{bad}, {late}, {good}]}}, document.getElementById("sections"))')
    browser.settle()
    text = browser.value("document.getElementById('tried').textContent")
    check.that(text.count("could not be drawn") == 2, f"charts that cannot be drawn say so: {text!r}")
    drawn = browser.value("[...document.querySelectorAll('#tried figure > svg')].pop().querySelectorAll('path').length")
    check.that(drawn == 1, "a chart after one that cannot be drawn is drawn")


def check_marks(browser, check):
    """Every series of a chart has a mark of its own, also where there are more of them than colours. The page has been opened."""
    series = ", ".join(f'{{name: "s{n}", x: [{n}], y: [{n}], marks: "points", dashed: false, labels: []}}' for n in range(20))
    chart = ('{title: "marks", x: {title: "x", log: false}, y: {title: "y", log: false}, markers: [], equal: false, diagonal: false, note: "", '
             f'series: [{series}]}}')
    browser.value(f'drawSection({{id: "marks", title: "marks", words: [], tables: [], charts: [{chart}]}}, document.getElementById("sections"))')
    browser.settle()
    marks = browser.value("[...document.querySelectorAll('#marks .legend svg')].map(s => [s.lastChild.tagName, s.lastChild.getAttribute('points'), s.lastChild.getAttribute('fill')].join(' '))")
    check.that(len(marks) == 20 and len(set(marks)) == 20, f"{len(set(marks))} of {len(marks)} marks differ")


def check_margins(browser, check):
    """On axes of equal scale no point lies on the border, where half of it would be outside. The page has been opened."""
    chart = ('{title: "equal", x: {title: "x", log: false}, y: {title: "y", log: false}, markers: [], equal: true, diagonal: true, note: "", '
             'series: [{name: "s", x: [-1, 2, 8], y: [0, 3, 8], marks: "points", dashed: false, labels: []}]}')
    browser.value(f'drawSection({{id: "equal", title: "equal", words: [], tables: [], charts: [{chart}]}}, document.getElementById("sections"))')
    browser.settle()
    inside = browser.value("(() => { const picture = document.querySelector('#equal figure > svg'), axis = picture.querySelector('.axis'), of = (e, n) => Number(e.getAttribute(n));"
                           " return [...picture.querySelectorAll('circle')].map(c => of(c, 'cx') - 3 > of(axis, 'x') && of(c, 'cy') - 3 > of(axis, 'y') &&"
                           " of(c, 'cx') + 3 < of(axis, 'x') + of(axis, 'width') && of(c, 'cy') + 3 < of(axis, 'y') + of(axis, 'height')); })()")
    check.that(inside == [True] * 3, f"points lie inside of axes of equal scale: {inside}")
    share = browser.value("document.querySelector('#equal figure').getBoundingClientRect().width / document.querySelector('main').getBoundingClientRect().width")
    check.that(share < 0.55, f"a chart alone in its row is no wider than beside another ({share:.2f} of the page)")


def main():
    program, scratch, pages = sys.argv[1], os.path.abspath(sys.argv[2]), sys.argv[3:]
    chromium = find_browser()
    if chromium is None:
        print("skipped: Chromium is missing: install the package chromium")
        return SKIPPED
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    write_walk(scratch + "/results/locomote", "menger-locomote", 0.01, 5)
    write_walk(scratch + "/results/simulate", "menger-simulate", 0.02, 150000)
    made = subprocess.run([program, scratch + "/results", "--no-animations"], capture_output=True, text=True, check=False)
    print(made.stdout + made.stderr, flush=True)
    if made.returncode != 0:
        return 1
    if "three.js is missing" in made.stdout:
        print("skipped: three.js is missing: install the package libjs-three")
        return SKIPPED
    check = Check()
    browser = Browser(chromium, scratch)
    try:
        for page in [scratch + "/results/report.html"] + pages:
            check_page(browser, check, page, os.path.basename(os.path.dirname(page)))
        browser.open(scratch + "/results/report.html")
        browser.settle()
        check_first_view(browser, check)
        check_ends(browser, check)
        check_chambers(browser, check)
        check.that(browser.value("typeof window.harmed") == "undefined", "names of files run no code")
        check.that(browser.value("document.querySelectorAll('img[src=x]').length") == 0, "names of files make no elements")
        check.that(HOSTILE in browser.value("document.body.textContent"), "names of files are shown as they are")
        check_narrow_table(browser, check)
        check_bad_chart(browser, check)
        browser.resize(1400, 1000)
        check_margins(browser, check)
        check_marks(browser, check)
        complaints = browser.complaints()
        check.that(not complaints, f"the console has no error or warning, and nothing is loaded: {complaints}")
    finally:
        browser.close()
    if check.failed == 0:
        shutil.rmtree(scratch, ignore_errors=True)
    return 1 if check.failed else 0


if __name__ == "__main__":
    sys.exit(main())
