#!/usr/bin/python3
"""What a straight section costs where a wall meets an edge: a square tube under pressure, in plane strain.

corner.py TABLE.csv    makes the table: growth of the tube, and how much less it grows when the end of every wall stays straight
Exit codes: 0 done, 2 wrong input.

By symmetry a quarter is enough: two walls from their middles to the edge, and the square of the edge between them. Biquadratic elements with the strain energy mu/2 (J^(-2/3) I1 - 3) + kappa/2 (P J - 1)^2, where P takes the best linear field in an
element, so that nothing locks. Gradients of the energy are taken by complex steps, tangents by differences of gradients.
"""

import pathlib
import sys

import numpy
import scipy.sparse
import scipy.sparse.linalg

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from small_tables import InputError, cell, run_script, write_table  # noqa: E402

MU_PA = 86.7e3  # Dragon Skin 10
KAPPA_PA = 50.0 * MU_PA
WALL_M = 2e-3
HALF_SPAN_M = 3e-3
ELEMENTS_ALONG = 4  # from the middle of a wall to the edge; two through the wall and along each side of the edge
ELEMENTS_THROUGH = 2
PRESSURES_PA = [1e3, 8e3, 24e3]
STEPS = 3  # of the load from one pressure to the next

GAUSS = numpy.array([-(0.6**0.5), 0.0, 0.6**0.5])
WEIGHTS = numpy.array([5.0, 8.0, 5.0]) / 18.0
# The area beside a quadratic curve is 1/2 sum of AREA[i][j] x_i cross x_j.
AREA = numpy.array([[0.0, 2 / 3, -1 / 6], [-2 / 3, 0.0, 2 / 3], [1 / 6, -2 / 3, 0.0]])


def shapes(x):
    """Values and derivatives of the three quadratic functions on [-1, 1]."""
    return numpy.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), numpy.array([x - 0.5, -2 * x, x + 0.5])


class Tube:
    """The mesh of a quarter of the tube, whose chamber is [0, HALF_SPAN_M]^2."""

    def __init__(self):
        self.places = {}
        self.points = []
        self.elements = []  # nine nodes and the two edges of a rectangle
        self.inner = []  # three nodes of each edge on the chamber, with the chamber on the left
        half, wall = HALF_SPAN_M, WALL_M
        self.add_block((half, 0.0), (wall, half), ELEMENTS_THROUGH, ELEMENTS_ALONG)
        self.add_block((0.0, half), (half, wall), ELEMENTS_ALONG, ELEMENTS_THROUGH)
        self.add_block((half, half), (wall, wall), ELEMENTS_THROUGH, ELEMENTS_THROUGH)
        step = half / ELEMENTS_ALONG
        for n in range(ELEMENTS_ALONG):
            at = [step * (n + part) for part in (0.0, 0.5, 1.0)]
            self.inner.append([self.node(half, y) for y in at])
            self.inner.append([self.node(x, half) for x in (half - y for y in at)])
        self.points = numpy.array(self.points)
        self.nodes = numpy.array([nodes for nodes, _ in self.elements])
        self.edges = numpy.array([edges for _, edges in self.elements])

    def node(self, x, y):
        key = (round(x * 1e9), round(y * 1e9))
        if key not in self.places:
            self.places[key] = len(self.points)
            self.points.append((x, y))
        return self.places[key]

    def add_block(self, corner, size, nx, ny):
        dx, dy = size[0] / nx, size[1] / ny
        for i in range(nx):
            for j in range(ny):
                nodes = [self.node(corner[0] + dx * (i + a / 2), corner[1] + dy * (j + b / 2)) for a in range(3) for b in range(3)]
                self.elements.append((nodes, (dx, dy)))

    def reduction(self, is_straight):
        """The matrix from free components to all: symmetry, and straight ends of the walls if they are wanted."""
        half, wall = HALF_SPAN_M, WALL_M
        count = len(self.points)
        matrix = scipy.sparse.lil_matrix((2 * count, 2 * count))
        ends = {0: (self.node(half, half), self.node(half, half + wall)), 1: (self.node(half, half), self.node(half + wall, half))}
        for n, point in enumerate(self.points):
            section = next((axis for axis in (0, 1) if abs(point[axis] - half) < 1e-9 and half < point[1 - axis] - 1e-9), None)
            is_within = section is not None and point[1 - section] < half + wall - 1e-9
            for c in (0, 1):
                if is_straight and is_within:
                    share = (point[1 - section] - half) / wall
                    matrix[2 * n + c, 2 * ends[section][0] + c] = 1.0 - share
                    matrix[2 * n + c, 2 * ends[section][1] + c] = share
                elif abs(point[c]) > 1e-12:  # nothing moves across a plane of symmetry
                    matrix[2 * n + c, 2 * n + c] = 1.0
        matrix = matrix.tocsc()
        return matrix[:, numpy.flatnonzero(matrix.getnnz(axis=0))].tocsr()

    def energies(self, u):
        """The strain energy of every element, J/m. u: displacements of its nodes, which may be complex."""
        dx, dy = self.edges.T
        ratios, squares, weights, basis = [], [], [], []
        for x, wx in zip(GAUSS, WEIGHTS):
            for y, wy in zip(GAUSS, WEIGHTS):
                (nx, gx), (ny, gy) = shapes(x), shapes(y)
                f1 = numpy.array([1.0, 0.0]) + numpy.einsum("a,naj->nj", numpy.outer(gx, ny).ravel(), u) * (2 / dx)[:, None]
                f2 = numpy.array([0.0, 1.0]) + numpy.einsum("a,naj->nj", numpy.outer(nx, gy).ravel(), u) * (2 / dy)[:, None]
                ratios.append(f1[:, 0] * f2[:, 1] - f1[:, 1] * f2[:, 0])
                squares.append((f1 * f1 + f2 * f2).sum(1) + 1.0)
                weights.append(wx * wy)
                basis.append([1.0, x, y])
        ratios, squares, weights, basis = map(numpy.array, (ratios, squares, weights, basis))
        fit = numpy.linalg.solve(numpy.einsum("g,ga,gb->ab", weights, basis, basis), numpy.einsum("g,ga,gn->an", weights, basis, ratios))
        density = MU_PA / 2 * (ratios ** (-2 / 3) * squares - 3.0) + KAPPA_PA / 2 * (basis @ fit - 1.0) ** 2
        return (weights @ density) * dx * dy

    def element_forces(self, u):
        forces = numpy.empty((len(u), 18))
        for k in range(18):
            moved = u.astype(complex)
            moved.reshape(len(u), -1)[:, k] += 1e-30j
            forces[:, k] = self.energies(moved).imag / 1e-30
        return forces

    def equilibrium_at(self, displacements, pressure_Pa):
        """Residual and tangent under pressure."""
        u = displacements.reshape(-1, 2)[self.nodes]
        components = (2 * self.nodes[:, :, None] + numpy.arange(2)).reshape(len(u), -1)
        residual = numpy.zeros(displacements.size)
        numpy.add.at(residual, components, self.element_forces(u))
        tangents = numpy.empty((len(u), 18, 18))
        step = 1e-9
        for k in range(18):
            more, less = u.copy(), u.copy()
            more.reshape(len(u), -1)[:, k] += step
            less.reshape(len(u), -1)[:, k] -= step
            tangents[:, :, k] = (self.element_forces(more) - self.element_forces(less)) / (2 * step)
        rows = [numpy.repeat(components, 18, axis=1).ravel()]
        columns = [numpy.tile(components, (1, 18)).ravel()]
        values = [tangents.ravel()]
        place = self.points + displacements.reshape(-1, 2)
        for edge in self.inner:
            for i, one in enumerate(edge):
                for j, other in enumerate(edge):
                    push = pressure_Pa * AREA[i][j]
                    residual[2 * one] -= push * place[other][1]
                    residual[2 * one + 1] += push * place[other][0]
                    rows.append([2 * one, 2 * one + 1])
                    columns.append([2 * other + 1, 2 * other])
                    values.append([-push, push])
        matrix = (numpy.concatenate(values), (numpy.concatenate(rows), numpy.concatenate(columns)))
        return residual, scipy.sparse.csr_matrix(matrix, shape=(displacements.size,) * 2)

    def area(self, displacements):
        place = self.points + displacements.reshape(-1, 2)
        x, y = place[numpy.array(self.inner)].transpose(2, 0, 1)
        return 0.5 * numpy.einsum("ij,ni,nj->", AREA, x, y) - 0.5 * numpy.einsum("ij,ni,nj->", AREA, y, x)

    def growth(self, is_straight):
        """The growth of the chamber at every pressure."""
        reduction = self.reduction(is_straight)
        displacements = numpy.zeros(2 * len(self.points))
        at_rest = self.area(displacements)
        reached, found = 0.0, []
        for pressure_Pa in PRESSURES_PA:
            for part in range(1, STEPS + 1):
                self.solve(displacements, reduction, reached + (pressure_Pa - reached) * part / STEPS)
            reached = pressure_Pa
            found.append(self.area(displacements) / at_rest - 1.0)
        return found

    def solve(self, displacements, reduction, pressure_Pa):
        for _ in range(40):
            residual, tangent = self.equilibrium_at(displacements, pressure_Pa)
            change = reduction @ scipy.sparse.linalg.spsolve((reduction.T @ tangent @ reduction).tocsc(), -(reduction.T @ residual))
            displacements += change
            if abs(change).max() < 1e-11:
                return
        raise InputError(f"no equilibrium was found at {pressure_Pa:g} Pa")


def main(arguments):
    if len(arguments) != 1:
        raise InputError("give the table to make")
    tube = Tube()
    free, straight = tube.growth(False), tube.growth(True)
    rows = [[n, cell(p), cell(a), cell(b / a - 1.0)] for n, (p, a, b) in enumerate(zip(PRESSURES_PA, free, straight), 1)]
    write_table(pathlib.Path(arguments[0]), ["state", "pressure_Pa", "volume_change", "straight_error"], rows)


run_script(main)
