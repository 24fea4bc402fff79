#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""netcdf_conventions.py FILE...: do netCDF files follow CF 1.10 and, where they name it, SGRID 0.3?

No checker of CF is in Debian, so what the conformance document of CF requires of such files stands here, and what SGRID
says of its topologies. Units are parsed by udunits2, the library CF refers to. One line a fault, exit 1 if there is any.
Elapsed time is the one exception: records have no date, so time has the unit s and no "since".
"""
import re
import subprocess
import sys

import netCDF4
import numpy

CANONICAL = {"depth": "m", "time": "s"}  # of CF's standard name table
AXES = "TZYX"
faults = []
units_seen = {}


def convertible(unit, into):
    """Whether udunits2 knows `unit` and converts it."""
    if (unit, into) not in units_seen:
        ran = subprocess.run(["udunits2", "-H", unit, "-W", into], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        units_seen[unit, into] = ran.returncode == 0 and "not convertible" not in ran.stderr
    return units_seen[unit, into]


def known(unit):
    return convertible(unit, unit)


class Check:
    def __init__(self, path):
        self.path = path
        self.file = netCDF4.Dataset(path)
        self.file.set_auto_maskandscale(False)
        self.conventions = getattr(self.file, "Conventions", "").split()
        self.topologies = [name for name, variable in self.file.variables.items() if hasattr(variable, "cf_role")]

    def fault(self, where, what):
        faults.append(f"{self.path}: {where}: {what}")

    def expect(self, true, where, what):
        if not true:
            self.fault(where, what)

    def run(self):
        self.expect("CF-1.10" in self.conventions, "Conventions", "does not name CF-1.10")
        for name in ("title", "source", "history"):
            self.expect(isinstance(getattr(self.file, name, None), str), "global", f"no {name}")
        for name, variable in self.file.variables.items():
            self.expect(re.fullmatch("[A-Za-z][A-Za-z0-9_]*", name), name, "no name of letters, digits and _")
            self.meaning(name, variable)
            self.values(name, variable)
            self.coordinates(name, variable)
        self.expect(bool(self.topologies) == ("SGRID-0.3" in self.conventions), "Conventions", "SGRID named, or not")
        for name in self.topologies:
            self.topology(name, self.file[name])

    def meaning(self, name, variable):
        self.expect(getattr(variable, "long_name", getattr(variable, "standard_name", "")), name, "no long_name")
        units = getattr(variable, "units", None)
        if units is not None:
            self.expect(known(units), name, f"udunits does not know the unit '{units}'")
        standard = getattr(variable, "standard_name", None)
        if standard is not None:
            self.expect(standard in CANONICAL, name, f"'{standard}' is no standard name")
            self.expect(units and convertible(units, CANONICAL.get(standard, "1")), name,
                        f"the unit of {standard} is not one of {CANONICAL.get(standard)}")

    def values(self, name, variable):
        kind = variable.dtype
        for attribute in ("_FillValue", "actual_range", "flag_values"):
            if hasattr(variable, attribute):
                self.expect(numpy.asarray(getattr(variable, attribute)).dtype == kind, name, f"{attribute} of another type")
        if kind is str or variable.ndim == 0:
            return
        values = variable[:]
        good = values[numpy.isfinite(values)] if values.dtype.kind == "f" else values
        if hasattr(variable, "actual_range"):
            self.expect(list(variable.actual_range) == [good.min(), good.max()], name, "actual_range is not that of the values")
        if hasattr(variable, "flag_values"):
            meanings = variable.flag_meanings.split(" ")
            self.expect(len(meanings) == len(variable.flag_values), name, "as many flag_meanings as flag_values")
            self.expect(all(re.fullmatch(r"[A-Za-z0-9_.+@-]+", word) for word in meanings), name, "flag_meanings")
            self.expect(set(numpy.unique(values)) <= set(variable.flag_values), name, "values that are no flag")

    def coordinates(self, name, variable):
        if variable.dimensions == (name,):
            self.expect(not hasattr(variable, "_FillValue") and hasattr(variable, "units"), name, "a coordinate: _FillValue, units")
            steps = numpy.diff(variable[:])
            self.expect((steps > 0).all() or (steps < 0).all(), name, "a coordinate that is not monotonic")
        axis = getattr(variable, "axis", None)
        self.expect(axis in (None, *AXES), name, f"axis {axis}")
        if axis == "Z" or getattr(variable, "standard_name", "") == "depth":
            self.expect(getattr(variable, "positive", "") in ("up", "down"), name, "vertical, without positive")
        axes = [getattr(self.file.variables.get(dimension), "axis", "") for dimension in variable.dimensions]
        places = [AXES.index(axis) for axis in axes if axis]
        self.expect(places == sorted(set(places)), name, f"dimensions in the order {axes}")
        for other in getattr(variable, "coordinates", "").split():
            self.expect(other in self.file.variables and set(self.file[other].dimensions) <= set(variable.dimensions), name,
                        f"coordinates: {other} is not of its dimensions")
        if hasattr(variable, "bounds"):
            bounds = self.file.variables.get(variable.bounds)
            self.expect(bounds is not None and bounds.dimensions[:-1] == variable.dimensions, name, "bounds")

    def topology(self, name, grid):
        """A grid_topology of SGRID 0.3, and what is said to lie on it."""
        self.expect(grid.cf_role == "grid_topology", name, "cf_role")
        count = int(grid.topology_dimension)
        cell = {2: "face", 3: "volume"}[count]
        nodes = grid.node_dimensions.split()
        self.expect(len(nodes) == count and set(nodes) <= set(self.file.dimensions), name, "node_dimensions")
        pairs = re.findall(r"(\w+): (\w+) \(padding: none\)", getattr(grid, cell + "_dimensions"))
        self.expect([node for _, node in pairs] == nodes, name, f"{cell}_dimensions")
        for own, node in pairs:
            self.expect(len(self.file.dimensions[node]) == len(self.file.dimensions[own]) + 1, name, f"padding of {own}")
        cells = [own for own, _ in pairs]
        for attribute, allowed in (("node_coordinates", nodes), (cell + "_coordinates", cells)):
            places = [self.file[place] for place in getattr(grid, attribute).split()]
            self.expect(len(places) == count and all(set(place.dimensions) <= set(allowed) for place in places), name, attribute)
        for other, variable in self.file.variables.items():
            lies_on = set(cells) <= set(variable.dimensions) and other not in getattr(grid, cell + "_coordinates").split()
            self.expect(lies_on == (getattr(variable, "grid", None) == name), other, f"grid of {name}")
            if lies_on:
                self.expect(variable.location == cell, other, f"location is not {cell}")
        self.corners(name, grid, cells)

    def corners(self, name, grid, cells):
        """Cells lie between their corners."""
        depth, corners = self.file["depth"][:], self.file[grid.node_coordinates.split()[-1]][:]
        means = corners
        for axis in range(corners.ndim):
            means = (numpy.take(means, range(1, means.shape[axis]), axis) + numpy.take(means, range(means.shape[axis] - 1), axis)) / 2
        self.expect(numpy.allclose(means, depth, atol=1e-3), name, "cells are not at the mean of their corners")
        for own, node in zip(cells[:-1], grid.node_dimensions.split()):
            edges = self.file[node][:]
            self.expect(numpy.allclose((edges[1:] + edges[:-1]) / 2, self.file[own][:]), node, f"not around {own}")


for path in sys.argv[1:]:
    Check(path).run()
for fault in faults:
    print(fault)
sys.exit(1 if faults or len(sys.argv) < 2 else 0)
