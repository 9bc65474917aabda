"""Run by pvpython: paraview_open.py STATE FOLDER RUN.pvd: loads the state that `cuticle view --export` wrote, takes its picture, and writes
the arrays of the frames of a run."""
import json
import pathlib
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

state, folder, run = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
reader = simple.OpenDataFile(run)
frames = list(reader.TimestepValues)
found = {}
for k, time in enumerate(frames):
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    data = data.GetBlock(0) if data.IsA("vtkMultiBlockDataSet") else data
    found[f"points_{k}"] = vtk_to_numpy(data.GetPoints().GetData())
    found[f"lines_{k}"] = numpy.array(data.GetNumberOfLines())
numpy.savez(folder / "paraview.npz", **found)
simple.Delete(reader)
exec(compile(open(state).read(), state, "exec"), {"__file__": state})
view = simple.GetActiveView()
view.ViewSize = [500, 500]
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.6, 0.25, 1.0], [0, 0.03, 0], [0, 1, 0]
view.CameraViewAngle = 25
simple.Render()
simple.SaveScreenshot(str(folder / "paraview.png"), view, ImageResolution=[500, 500])
source = simple.GetActiveSource()
shown = servermanager.Fetch(source)
shown = shown.GetBlock(0) if shown.IsA("vtkMultiBlockDataSet") else shown
(folder / "paraview.json").write_text(json.dumps({"version": str(simple.GetParaViewVersion()), "frames": frames, "points": shown.GetNumberOfPoints(),
                                                  "arrays": sorted(shown.GetPointData().GetArrayName(i) for i in range(shown.GetPointData().GetNumberOfArrays()))}))
