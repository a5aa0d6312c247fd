"""Open3D's normals of the clouds that `large_surfaces` wrote (README.md, "Points without normals or radii"): mean and 99th hundredth of their errors in
degrees, and points a second of processor time, the best of some runs.

    python3 -m venv v && v/bin/pip install open3d-cpu==0.20.0 && OMP_NUM_THREADS=1 v/bin/python benches/normals_by_open3d.py /tmp/clouds
"""

import pathlib
import sys
import time

import numpy as np
import open3d

NEIGHBORS = 13  # the point itself among them
MOST_POINTS = 200_000  # of all runs of one cloud


def normals(places):
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(places))
    begin = time.process_time()
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NEIGHBORS))
    return np.asarray(cloud.normals), time.process_time() - begin


def main(folder):
    for path in sorted(pathlib.Path(folder).glob("*.xyz"), key=lambda path: int(path.stem.rsplit(" ", 1)[1])):
        rows = np.loadtxt(path)
        runs = [normals(rows[:, :3]) for _ in range(max(1, MOST_POINTS // len(rows)))]
        cosines = np.abs((runs[0][0] * rows[:, 3:]).sum(1)).clip(0, 1)
        errors = np.degrees(np.arccos(cosines))
        rate = len(rows) / min(secs for _, secs in runs)
        print(f"{path.stem:26} mean {errors.mean():.2f} p99 {np.percentile(errors, 99):.2f} {rate / 1e3:.0f}k points/s", flush=True)


main(*sys.argv[1:])
