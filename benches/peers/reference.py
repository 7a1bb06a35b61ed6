"""The load factor to some 1e-12: an optimal basis of the plane linear program, its basic solution in extended precision.

HiGHS names a basis (interior points, crossover, simplex). Which columns are basic decides the number; it is solved for again with
residuals in 80-bit arithmetic, and the basis counts as optimal only as far as the refined forces obey their cones and the refined
multipliers are admissible: both violations are returned with the value. Loads and objective are enlarged by `LARGE` before HiGHS sees
them, because its feasibility tolerances are absolute and no less than 1e-10.
"""

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from conic import highs, highs_program

LARGE = 1e4
ROUNDS = 8


def refined(factors, coo, rhs, transposed):
    """Solves a square sparse system, factorised already, with residuals in extended precision."""
    to, of = (coo.col, coo.row) if transposed else (coo.row, coo.col)
    values = coo.data.astype(np.longdouble)
    x = np.zeros(len(rhs), dtype=np.longdouble)
    for _ in range(ROUNDS):
        residual = rhs.astype(np.longdouble)
        np.subtract.at(residual, to, values * x[of])
        x += factors.solve(residual.astype(float), trans="T" if transposed else "N")
    return x


def reference(model):
    """(load factor, how far the refined forces leave their cones, how far the multipliers leave theirs)"""
    import highspy

    matrix, dead, faces, lower = highs_program(model, True)
    solver = highs(matrix, LARGE * dead, faces, lower, "ipm", primal_feasibility_tolerance=1e-10, dual_feasibility_tolerance=1e-10)
    solver.changeColCost(matrix.shape[1] - 1, -LARGE)
    solver.run()
    basic = highspy.HighsBasisStatus.kBasic
    basis = solver.getBasis()
    in_columns = np.array([s == basic for s in basis.col_status])
    in_rows = np.array([s == basic for s in basis.row_status])
    columns, slacks = np.flatnonzero(in_columns), np.flatnonzero(in_rows)
    rows, balance = matrix.shape[0], len(dead)
    # Row activities are unknowns too: M x - r = 0, with r at its bound where it is not basic; every bound is -dead or zero.
    identity = sp.csc_matrix((-np.ones(len(slacks)), (slacks, np.arange(len(slacks)))), shape=(rows, len(slacks)))
    square = sp.hstack([matrix[:, columns], identity]).tocsc()
    factors, coo = sla.splu(square), square.tocoo()
    rhs = np.concatenate([-dead, np.zeros(faces)])
    cost = np.zeros(square.shape[1])
    cost[np.flatnonzero(columns == matrix.shape[1] - 1)] = -1.0
    x = refined(factors, coo, rhs, False)
    y = refined(factors, coo, cost, True)
    value = -float(x @ cost)
    # Primal: n >= 0 and the rows of the cones <= 0. Dual: reduced costs of n at its bound >= 0, multipliers of tight cone rows <= 0.
    forces = x[: len(columns)]
    bounded = np.isfinite(lower[columns])
    cones = x[len(columns) :][slacks >= balance]
    outside = max(0.0, float(-forces[bounded].min(initial=0.0)), float(cones.max(initial=0.0)))
    reduced = -(matrix.T @ y.astype(float))
    reduced[-1] -= 1.0
    resting = ~in_columns & np.isfinite(lower)
    tight = ~in_rows[balance:]
    wrong = max(0.0, float(-reduced[resting].min(initial=0.0)), float(y[balance:][tight].max(initial=0.0)))
    return value, outside, wrong
