"""The load factor to some 1e-12: the optimal basis of the plane linear program, its basic solution in extended precision.

HiGHS names the basis (interior points, then crossover); which program that is and which columns are basic decides the number, so it is solved again with
residuals in 80-bit arithmetic, and the objective of the dual solution of the same basis has to agree.
"""

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from conic import highs, highs_program


def refined(matrix, rhs):
    """Solves a square sparse system with residuals in extended precision."""
    factors = sla.splu(matrix.tocsc())
    coo = matrix.tocoo()
    values = coo.data.astype(np.longdouble)
    x = np.zeros(matrix.shape[1], dtype=np.longdouble)
    for _ in range(6):
        residual = rhs.astype(np.longdouble)
        np.subtract.at(residual, coo.row, values * x[coo.col])
        x += factors.solve(residual.astype(float))
    return x


def reference(model):
    """(load factor, how far primal and dual value of the basis differ)"""
    matrix, dead, faces, lower = highs_program(model, True)
    solver = highs(matrix, dead, faces, lower, "ipm", primal_feasibility_tolerance=1e-10, dual_feasibility_tolerance=1e-10)
    solver.run()
    import highspy

    basic = highspy.HighsBasisStatus.kBasic
    basis = solver.getBasis()
    columns = np.flatnonzero([s == basic for s in basis.col_status])
    slacks = np.flatnonzero([s == basic for s in basis.row_status])
    rows = matrix.shape[0]
    # Row activities are unknowns too: M x - r = 0, with r fixed at its bound where it is not basic; every bound is -dead or zero.
    identity = sp.csc_matrix((-np.ones(len(slacks)), (slacks, np.arange(len(slacks)))), shape=(rows, len(slacks)))
    square = sp.hstack([matrix[:, columns], identity]).tocsc()
    rhs = np.concatenate([-dead, np.zeros(faces)])
    cost = np.zeros(square.shape[1])
    cost[np.flatnonzero(columns == matrix.shape[1] - 1)] = 1.0
    primal = refined(square, rhs) @ cost
    dual = refined(square.T.tocsc(), cost) @ rhs.astype(np.longdouble)
    return float(primal), float(abs(primal - dual))
