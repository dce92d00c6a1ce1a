// What SimVascular's svSolver and its presolver may say, and what becomes of it.
#include <array>

#include "tunica/peer_cases/vocabulary.hpp"

namespace tunica::peer_cases {

namespace {

constexpr const char *written = "tunica needs no files of the presolver", *rest = "a run starts at rest",
                     *own = "of svSolver's own scheme and linear solver", *deformable = "the coupled momentum method",
                     *output = "tunica writes its own selection of fields and histories",
                     *follows = "follows from the lists";

constexpr KeyRule used(const char* key, bool repeats = false) {
  return {key, Kind::text, Use::used, "", nullptr, repeats};
}
constexpr KeyRule dropped(const char* key, const char* why, bool repeats = true) {
  return {key, Kind::text, Use::dropped, why, nullptr, repeats};
}
constexpr KeyRule refused(const char* key, const char* physics, Kind kind = Kind::path) {
  return {key, kind, Use::refused, physics, nullptr, true};
}

constexpr auto commands = std::to_array<KeyRule>({
    used("bct_analytical_shape", true),
    used("bct_create", true),
    used("bct_fourier_mode_number", true),
    used("bct_period", true),
    used("fluid_density"),
    used("fluid_viscosity"),
    used("initial_pressure"),
    used("mesh_and_adjncy_vtu"),
    used("mesh_vtu"),
    used("noslip_vtp", true),
    used("pressure_vtp", true),
    used("set_surface_id_vtp", true),
    used("zero_pressure_vtp", true),
    dropped("bct_flip", "the sign of a flow"),
    dropped("bct_merge_on", written),
    dropped("bct_point_number", "the series is evaluated at every instant"),
    dropped("bct_write_dat", written),
    dropped("bct_write_vtp", written),
    dropped("initial_velocity", rest),
    dropped("prescribed_velocities_vtp", "bct_create names the faces of inflow"),
    dropped("write_geombc", written),
    dropped("write_numstart", written),
    dropped("write_restart", written),
    refused("deformable_E", deformable),
    refused("deformable_create_mesh_vtp", deformable),
    refused("deformable_direct_solve_displacements", deformable),
    refused("deformable_kcons", deformable),
    refused("deformable_nu", deformable),
    refused("deformable_pressure", deformable),
    refused("deformable_solve_varwall_displacements", deformable),
    refused("deformable_thickness", deformable),
    refused("deformable_wall_vtp", deformable),
    refused("deformable_write_vtp", deformable),
    refused("fix_free_edge_nodes_vtp", deformable),
    refused("set_surface_E_vtp", deformable),
    refused("set_surface_thickness_vtp", deformable),
    refused("solve_varwall_E", deformable),
    refused("solve_varwall_thickness", deformable),
    refused("wall_displacements_write_vtp", deformable),
});

constexpr auto settings = std::to_array<KeyRule>({
    used("Backflow Stabilization Coefficient"),
    used("Density"),
    used("List of RCR Surfaces"),
    used("List of Resistance Surfaces"),
    used("Number of Timesteps"),
    used("Number of Timesteps between Restarts"),
    used("Residual Criteria"),
    used("Resistance Values"),
    used("Time Integration Rho Infinity"),
    used("Time Step Size"),
    used("Viscosity"),
    dropped("Basis Function Order", own),
    dropped("Data Block Format", own),
    dropped("Equation of State", own),
    dropped("Flow Advection Form", own),
    dropped("Force Calculation Method", output),
    dropped("Include Viscous Correction in Stabilization", own),
    dropped("Lumped Mass Fraction on Left-hand-side", own),
    dropped("Lumped Mass Fraction on Right-hand-side", own),
    dropped("Maximum Number of Iterations for svLS Continuity Loop", own),
    dropped("Maximum Number of Iterations for svLS Momentum Loop", own),
    dropped("Maximum Number of Iterations for svLS NS Solver", own),
    dropped("Minimum Required Iterations", "a step ends when it has converged"),
    dropped("Number of Coupled Surfaces", follows),
    dropped("Number of Force Surfaces", output),
    dropped("Number of Krylov Vectors per GMRES Sweep", own),
    dropped("Number of RCR Surfaces", follows),
    dropped("Number of Resistance Surfaces", follows),
    dropped("Number of Solves per Left-hand-side Formation", own),
    dropped("Number of Surfaces which Output Pressure and Flow", output),
    dropped("List of Output Surfaces", output),
    dropped("Number of Timesteps for GenBC Initialization", follows),
    dropped("Output Surface Stress", output),
    dropped("Output Wall Shear Stress", output),
    dropped("Pressure Coupling", "outlets are coupled implicitly"),
    dropped("Print Average Solution", output),
    dropped("Print Error Indicators", output),
    dropped("Print Statistics", output),
    dropped("Print Wall Fluxes", output),
    dropped("Print ybar", output),
    dropped("Quadrature Rule on Boundary", own),
    dropped("Quadrature Rule on Interior", own),
    dropped("RCR Values From File", follows),
    dropped("Residual Control", "a step ends when it has converged"),
    dropped("Solver Type", own),
    dropped("Step Construction", "a step ends when it has converged"),
    dropped("Surface ID's for Force Calculation", output),
    dropped("Tau C Scale Factor", own),
    dropped("Tau Matrix", own),
    dropped("Tau Time Constant", own),
    dropped("Time Integration Rule", "generalised-alpha of second order"),
    dropped("Time Varying Boundary Conditions From File", "the flow is read from its own file"),
    dropped("Tolerance on Continuity Equations", own),
    dropped("Tolerance on Momentum Equations", own),
    dropped("Tolerance on svLS NS Solver", own),
    dropped("Verbosity Level", output),
    dropped("Viscous Control", own),
    dropped("svLS Type", own),
    refused("Deformable Wall", deformable, Kind::flag),
    refused("Lagrange Multipliers", "constrained profiles at outlets", Kind::flag),
    refused("Number of COR Surfaces", "coronary outlets", Kind::integer),
    refused("Number of Constrained Surfaces", "constrained profiles at outlets", Kind::integer),
    refused("Number of Dirichlet Surfaces", "genBC's zero-dimensional models", Kind::integer),
    refused("Number of Impedance Surfaces", "outlets by their impedance", Kind::integer),
    refused("Number of Neumann Surfaces", "genBC's zero-dimensional models", Kind::integer),
    refused("Number of Normal Constrained Surfaces", "constrained profiles at outlets", Kind::integer),
});

}  // namespace

const SectionRule svpre_section{commands}, svsolver_section{settings};

}  // namespace tunica::peer_cases
