# Tetrahedralizes the points of a .node file, or the PLC of a .poly file, with TetGen 1.6, which tells its time itself.
# Its Python binding takes triangles only.
import sys

import numpy
from tetgen._tetgen import PyTetgen


def numbers(path):
    with open(path) as lines:
        for line in lines:
            words = line.split("#")[0].split()
            if words:
                yield words


rows = numbers(sys.argv[1])
count, _, attributes, markers = map(int, next(rows)[:4])
points, first = [], None
for _ in range(count):
    words = next(rows)
    first = int(words[0]) if first is None else first
    points.append([float(x) for x in words[1:4]])
points = numpy.array(points)
facets = []
if not sys.argv[1].endswith(".node"):
    for _ in range(int(next(rows)[0])):
        polygons = [int(x) for x in next(rows)[:2]]
        corners = [int(x) - first for x in next(rows)[1:]]
        if polygons[0] != 1 or any(polygons[1:]) or len(corners) != 3:
            sys.exit("a facet that is no triangle")
        facets.append(corners)
tetgen = PyTetgen()
tetgen.load_mesh(points, numpy.array(facets, numpy.int32).reshape(-1, 3))
tetgen.tetrahedralize(switches_str=sys.argv[2])
