"""Peers that solve the load-factor program: maximise lambda, A f + dead + lambda live = 0, friction cones.

Each returns (lambda, seconds building, seconds solving, the tool's own word). The cone is the second-order cone for the conic solvers,
the same as voussoir's. HiGHS takes linear constraints: a pyramid of four faces with edges along t1 and t2, which is exact here because
the force that counts lies along a tangent in the plane of the scene, and is an outright different (smaller) cone in general.
"""

from time import perf_counter

import numpy as np
import scipy.sparse as sp

from model import equilibrium, plane


def cvxpy_peer(solver, **settings):
    """CVXPY's modelling language on one of its solvers, written with whole arrays (no loop over points)."""

    def run(model):
        import cvxpy as cp

        start = perf_counter()
        a, dead, live = equilibrium(model)
        points = len(model.mu)
        f, load_factor = cp.Variable(3 * points), cp.Variable()
        force = cp.reshape(f, (3, points), order="F")
        balance = a @ f + dead + load_factor * live == 0
        cones = cp.SOC(cp.multiply(model.mu, force[2]), force[:2])
        problem = cp.Problem(cp.Maximize(load_factor), [balance, cones])
        problem.solve(solver=solver, **settings)
        total = perf_counter() - start
        solving = problem.solver_stats.solve_time or 0.0
        solving += problem.solver_stats.setup_time or 0.0
        value = None if load_factor.value is None else float(load_factor.value)
        return value, total - solving, solving, problem.status

    return run


def clarabel_program(a, dead, live, mu, cones):
    """min -lambda over (f, lambda): [A live] x = -dead, then the cones' rows as s = b - M x."""
    import clarabel

    unknowns = a.shape[1] + 1
    if cones == "second-order":
        p = len(mu)
        # rows (mu n, t1, t2) of each point
        rows = np.arange(3 * p)
        columns = np.column_stack([3 * np.arange(p) + 2, 3 * np.arange(p), 3 * np.arange(p) + 1]).reshape(-1)
        values = np.column_stack([mu, np.ones(p), np.ones(p)]).reshape(-1)
        g = sp.csc_matrix((-values, (rows, columns)), shape=(3 * p, unknowns))
        kinds = [clarabel.SecondOrderConeT(3)] * p
    else:
        g = sp.hstack([wedge(mu), sp.csc_matrix((2 * len(mu), 1))])
        kinds = [clarabel.NonnegativeConeT(2 * len(mu))]
    matrix = sp.vstack([sp.hstack([a, live.reshape(-1, 1)]), g]).tocsc()
    rhs = np.concatenate([-dead, np.zeros(g.shape[0])])
    objective = np.zeros(unknowns)
    objective[-1] = -1.0
    return sp.csc_matrix((unknowns, unknowns)), objective, matrix, rhs, [clarabel.ZeroConeT(a.shape[0]), *kinds]


def wedge(mu):
    """Rows of s = -M f >= 0 for |t| <= mu n, with (t, n) a point (n >= 0 follows)."""
    p = len(mu)
    t, n = 2 * np.arange(p), 2 * np.arange(p) + 1
    one = np.ones(p)
    rows = np.concatenate([t, t, n, n])
    return sp.csc_matrix((np.concatenate([one, -mu, -one, -mu]), (rows, np.concatenate([t, n, t, n]))), shape=(2 * p, 2 * p))


def clarabel_peer(cones, tolerance=None):
    """The solver that voussoir uses, through its own Python interface: no modelling language in between."""

    def run(model):
        import clarabel

        start = perf_counter()
        a, dead, live, mu = plane(model) if cones == "plane" else (*equilibrium(model), model.mu)
        program = clarabel_program(a, dead, live, mu, cones)
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        if tolerance is not None:
            settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        built = perf_counter()
        solution = clarabel.DefaultSolver(*program, settings).solve()
        return float(solution.x[-1]), built - start, perf_counter() - built, str(solution.status)

    return run


def highs_program(model, flat):
    """Columns (f, lambda), rows: equilibrium, then the faces of the cones."""
    if flat:
        a, dead, live, mu = plane(model)
        faces = wedge(mu)
        lower = np.full(a.shape[1], -np.inf)
        lower[1::2] = 0.0
    else:
        a, dead, live = equilibrium(model)
        p = len(model.mu)
        # |t1| + |t2| <= mu n: the inscribed pyramid.
        signs = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]], dtype=float)
        values = np.concatenate([np.broadcast_to(signs, (p, 4, 2)), np.broadcast_to(-model.mu.reshape(-1, 1, 1), (p, 4, 1))], axis=2)
        rows = np.broadcast_to((4 * np.arange(p)).reshape(-1, 1, 1) + np.arange(4).reshape(1, -1, 1), values.shape)
        columns = np.broadcast_to((3 * np.arange(p)).reshape(-1, 1, 1) + np.arange(3), values.shape)
        faces = sp.csc_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape=(4 * p, 3 * p))
        lower = np.full(a.shape[1], -np.inf)
        lower[2::3] = 0.0
    matrix = sp.vstack([sp.hstack([a, live.reshape(-1, 1)]), sp.hstack([faces, sp.csc_matrix((faces.shape[0], 1))])]).tocsc()
    return matrix, dead, faces.shape[0], np.concatenate([lower, [-np.inf]])


def highs(matrix, dead, faces, lower, method, **options):
    """A HiGHS instance with the program in it."""
    import highspy

    lp = highspy.HighsLp()
    rows, columns = matrix.shape
    lp.num_col_, lp.num_row_ = columns, rows
    lp.col_cost_ = np.concatenate([np.zeros(columns - 1), [-1.0]])
    lp.col_lower_, lp.col_upper_ = lower, np.full(columns, np.inf)
    lp.row_lower_ = np.concatenate([-dead, np.full(faces, -np.inf)])
    lp.row_upper_ = np.concatenate([-dead, np.zeros(faces)])
    lp.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    lp.a_matrix_.start_, lp.a_matrix_.index_, lp.a_matrix_.value_ = matrix.indptr, matrix.indices, matrix.data
    solver = highspy.Highs()
    solver.silent()
    solver.setOptionValue("solver", method)
    solver.setOptionValue("threads", 1)
    for key, value in options.items():
        solver.setOptionValue(key, value)
    solver.passModel(lp)
    return solver


def highs_peer(flat, method):
    """HiGHS on the linear program, by simplex or interior points (with crossover)."""

    def run(model):
        import highspy  # noqa: F401  (not counted as building)

        start = perf_counter()
        solver = highs(*highs_program(model, flat), method)
        built = perf_counter()
        solver.run()
        seconds = perf_counter() - built
        value = solver.getSolution().col_value[-1]
        return float(value), built - start, seconds, solver.modelStatusToString(solver.getModelStatus())

    return run
