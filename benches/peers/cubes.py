"""Marching cubes of scikit-image and PyMCubes on the gyroid ball, for the bench beside them: reads lines `who cells`, answers each
with the number of triangles. What depends on one axis is computed once per axis, as numpy lets one write it."""

import sys

import numpy as np


def sample(cells, kind):
    u = (30 * np.linspace(-1, 1, cells + 1)).astype(kind)
    x, y, z = u[:, None, None], u[None, :, None], u[None, None, :]
    wave = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    ball = np.sqrt(x**2 + y**2 + z**2) - 25
    return -np.maximum(ball, np.abs(wave) - kind(0.2))


def triangles(who, cells):
    if who == "scikit-image":
        from skimage.measure import marching_cubes

        return len(marching_cubes(sample(cells, np.float32), 0.0)[1])
    import mcubes

    return len(mcubes.marching_cubes(sample(cells, np.float64), 0.0)[1])


def main():
    for line in sys.stdin:
        who, cells = line.split()
        try:
            print(triangles(who, int(cells)), flush=True)
        except ImportError:
            print("missing", flush=True)


main()
