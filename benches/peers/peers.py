"""The peers by name."""

from conic import clarabel_peer, cvxpy_peer, highs_peer
from coupled import coupled_peer

# name -> (what it is, cone, function of the model)
PEERS = {
    "cvxpy-clarabel": ("CVXPY with Clarabel, default settings", "second-order", cvxpy_peer("CLARABEL")),
    "cvxpy-clarabel-tight": (
        "CVXPY with Clarabel, tolerances 1e-12",
        "second-order",
        cvxpy_peer("CLARABEL", tol_gap_abs=1e-12, tol_gap_rel=1e-12, tol_feas=1e-12),
    ),
    "cvxpy-ecos": ("CVXPY with ECOS, default settings", "second-order", cvxpy_peer("ECOS")),
    "cvxpy-scs": ("CVXPY with SCS, default settings", "second-order", cvxpy_peer("SCS")),
    "cvxpy-scs-tight": (
        "CVXPY with SCS, eps 1e-7, at most 1e6 iterations",
        "second-order",
        cvxpy_peer("SCS", eps_abs=1e-7, eps_rel=1e-7, max_iters=1_000_000),
    ),
    "clarabel": ("Clarabel's own Python interface, same program as CVXPY's", "second-order", clarabel_peer("second-order")),
    "clarabel-plane": ("Clarabel, the program reduced to the plane by hand", "wedge (plane)", clarabel_peer("plane")),
    "clarabel-plane-tight": ("the same, tolerances 1e-12", "wedge (plane)", clarabel_peer("plane", 1e-12)),
    "highs-pyramid": ("HiGHS, its own choice of method", "pyramid, 4 faces", highs_peer(False, "choose")),
    "highs-plane": ("HiGHS, simplex, reduced to the plane by hand", "wedge (plane)", highs_peer(True, "simplex")),
    "highs-plane-ipm": ("HiGHS, interior points, reduced to the plane by hand", "wedge (plane)", highs_peer(True, "ipm")),
    "compas-rbe": ("compas_cra, rigid-block equilibrium, bisection", "pyramid, 8 faces", coupled_peer("rbe")),
    "compas-rbe-verdict": ("compas_cra, rigid-block equilibrium, dead load", "pyramid, 8 faces", coupled_peer("rbe", 0.0)),
    "compas-cra-verdict": ("compas_cra, coupled analysis, dead load", "pyramid, 8 faces, coupled", coupled_peer("cra", 0.0)),
}
