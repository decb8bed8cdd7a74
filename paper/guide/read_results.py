"""Reads what menger wrote with pandas and VTK: the archive of a search, curves and the frames of a walk.

read_results.py RUN.sqlite CURVES.csv FRAMES.pvd    (Debian: python3-pandas python3-vtk9)
"""

import sqlite3
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import pandas
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

archive, curves, frames = map(Path, sys.argv[1:])
with sqlite3.connect(f"file:{archive}?mode=ro", uri=True) as connection:
    best = pandas.read_sql("SELECT id, MAX(fitness) AS fitness FROM contender GROUP BY id ORDER BY fitness DESC LIMIT 5", connection)
print(best, pandas.read_csv(curves).tail(3), sep="\n")

for frame in list(xml.parse(frames).iter("DataSet"))[::20]:
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(frames.parent / frame.get("file")))
    reader.Update()
    points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
    print(f"{float(frame.get('timestep')):.3f} s: mean of the points at {points.mean(axis=0)} m")
