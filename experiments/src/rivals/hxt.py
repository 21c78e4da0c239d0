# Tetrahedralizes the points of a .node file with HXT and tells what gmsh tells of its time.
import sys

import gmsh

numbers = []
with open(sys.argv[1]) as lines:
    count = int(next(lines).split()[0])
    for _ in range(count):
        numbers.extend(map(float, next(lines).split()[1:4]))
gmsh.initialize()
gmsh.option.setNumber("General.NumThreads", int(sys.argv[2]))
gmsh.option.setNumber("Mesh.Algorithm3D", 10)  # HXT
gmsh.option.setNumber("General.Verbosity", 4)
gmsh.option.setNumber("General.Terminal", 1)
tetrahedra = gmsh.algorithm.tetrahedralize(numbers)[0]
print("tetrahedra:", len(tetrahedra) // 4)
