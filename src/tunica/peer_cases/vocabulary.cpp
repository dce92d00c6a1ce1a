#include "tunica/peer_cases/vocabulary.hpp"

#include <array>

#include "tunica/peer_cases/svsolver_files.hpp"

namespace tunica::peer_cases {

namespace {

constexpr KeyRule used(const char* key, Kind kind) { return {key, kind, Use::used}; }
constexpr KeyRule used(const char* key, const SectionRule& below, bool repeats = false) {
  return {key, Kind::section, Use::used, "", &below, repeats};
}
constexpr KeyRule dropped(const char* key, Kind kind, const char* why) { return {key, kind, Use::dropped, why}; }
constexpr KeyRule refused(const char* key, Kind kind, const char* physics) {
  return {key, kind, Use::refused, physics};
}

constexpr auto T = Kind::text, P = Kind::path, N = Kind::number, A = Kind::amount, I = Kind::integer, C = Kind::count,
               F = Kind::flag, V = Kind::vector, X = Kind::axes;

constexpr SectionRule anything{{}, true};

constexpr KeyRule refused_section(const char* key, const char* physics) {
  return {key, Kind::section, Use::refused, physics, &anything, true};
}

// --- general ------------------------------------------------------------------------------------------------------

constexpr const char *logging = "tunica's log has one level",
                     *initial_fields = "initial fields of the whole in one file; those of each mesh are read",
                     *vtu_names = "results have tunica's names";

constexpr auto general_keys = std::to_array<KeyRule>({
    used("Continue_previous_simulation", F),
    used("Increment_in_saving_VTK_files", C),
    used("Increment_in_saving_restart_files", C),
    used("Number_of_spatial_dimensions", I),
    used("Number_of_time_steps", C),
    used("Save_results_in_folder", P),
    used("Spectral_radius_of_infinite_time_step", N),
    used("Time_step_size", N),
    dropped("Check_IEN_order", F, "the order of element nodes is always checked"),
    dropped("Colorful_terminal_output", F, logging),
    dropped("Debug", F, logging),
    dropped("Name_prefix_of_saved_VTK_files", T, vtu_names),
    dropped("Overwrite_restart_file", F, "the last checkpoints are kept"),
    dropped("Restart_file_name", T, "`tunica run --restart` finds the last checkpoint"),
    dropped("Save_averaged_results", F, "`tunica post` averages over cycles"),
    dropped("Save_results_to_VTK_format", F, "results are always written"),
    dropped("Searched_file_name_to_trigger_stop", T, "Ctrl-C or SIGTERM ends a run with a checkpoint"),
    dropped("Start_averaging_from_zero", F, "`tunica post` averages over cycles"),
    dropped("Start_saving_after_time_step", C, "fields are written from the start"),
    dropped("Use_separator_in_the_history_file", F, logging),
    dropped("Verbose", F, logging),
    dropped("Warning", F, logging),
    refused("Convert_BIN_to_VTK_format", F, "conversion of svMultiPhysics' restart files"),
    refused("Number_of_initialization_time_steps", I, "first steps of a tenth of the size"),
    refused("Simulation_initialization_file_path", P, initial_fields),
    refused("Simulation_requires_remeshing", F, "remeshing during a run"),
    refused("Starting_time_step", I, "a run that goes on from svMultiPhysics' restart files"),
    refused_section("Contact_model", "contact"),
});
constexpr SectionRule general_section{general_keys};

// --- meshes -------------------------------------------------------------------------------------------------------

constexpr const char* quadrature = "tunica's quadrature is exact for what it integrates";

constexpr auto face_keys = std::to_array<KeyRule>({
    used("Face_file_path", P),
    dropped("Quadrature_modifier_TRI3", N, quadrature),
    refused("Connectivity_file_path", P, "faces as eBC files; SimVascular's .vtp files are read"),
    refused("End_nodes_face_file_path", P, "one-dimensional fibre networks"),
});
constexpr SectionRule face_section{face_keys};

constexpr auto mesh_keys = std::to_array<KeyRule>({
    used("Add_face", face_section, true),
    used("Domain", C),
    used("Domain_file_path", P),
    {"Fiber_direction", V, Use::used, "", nullptr, true},
    {"Fiber_direction_file_path", P, Use::used, "", nullptr, true},
    used("Mesh_file_path", P),
    used("Mesh_scale_factor", N),
    used("Prestress_file_path", P),
    dropped("Quadrature_modifier_TET4", N, quadrature),
    refused("Connectivity_file_path", P, "meshes as lists of elements; SimVascular's .vtu files are read"),
    refused("Convert_elements_to_biquadratic_elements", F, "elements in two dimensions"),
    refused("Coordinates_file_path", P, "meshes as lists of coordinates; SimVascular's .vtu files are read"),
    refused("Gambit_mesh_file_path", P, "Gambit's meshes"),
    used("Initial_displacements_file_path", P),
    used("Initial_pressures_file_path", P),
    used("Initial_velocities_file_path", P),
    refused("NURBS_data_file_path", P, "NURBS elements"),
    refused("Set_mesh_as_fibers", F, "one-dimensional fibre networks"),
    refused("Set_mesh_as_shell", F, "shells"),
    refused_section("Set_direction", "NURBS elements"),
    refused_section("Set_domain", "Gambit's meshes"),
});
constexpr SectionRule mesh_section{mesh_keys};

constexpr auto projection_keys = std::to_array<KeyRule>({
    used("Project_from_face", T),
    dropped("Projection_tolerance", N, "`meshes.interface.tolerance` is a share of the local edge length"),
});
constexpr SectionRule projection_section{projection_keys};

// --- materials ----------------------------------------------------------------------------------------------------

constexpr auto constitutive_keys = std::to_array<KeyRule>({
    used("a", N),   used("a4", N),  used("a6", N),    used("a4f", N),
    used("a4s", N), used("afs", N), used("b", N),     used("b4", N),
    used("b6", N),  used("b4f", N), used("b4s", N),   used("bf", N),
    used("bfs", N), used("bt", N),  used("c", N),     used("c1", N),
    used("c2", N),  used("k", N),   used("kappa", N), used("a0", N),
    used("b1", N),  used("b2", N),  used("mu0", N),   refused_section("Add_row", "a law as a neural network"),
});
constexpr SectionRule constitutive_section{constitutive_keys};

constexpr auto viscosity_keys = std::to_array<KeyRule>({
    used("Value", N),
    used("Asymptotic_viscosity_parameter", N),
    used("Limiting_high_shear_rate_viscosity", N),
    used("Limiting_low_shear_rate_viscosity", N),
    used("Low_shear_rate_threshold", N),
    used("Power_law_index", N),
    used("Shear_rate_tensor_exponent", N),
    used("Shear_rate_tensor_multiplier", N),
    used("Yield_stress_parameter", N),
});
constexpr SectionRule viscosity_section{viscosity_keys};

constexpr const char *electrophysiology = "of electrophysiology", *body_force = "body forces such as gravity",
                     *active = "active stress of muscle";

/// Of a domain, and of an equation that has one domain only.
#define TUNICA_DOMAIN_KEYS                                                                                             \
  used("Backflow_stabilization_coefficient", N), used("Constitutive_model", constitutive_section),                     \
      used("Continuity_stabilization_coefficient", N), used("Density", N), used("Dilational_penalty_model", T),        \
      used("Elasticity_modulus", N), used("Equation", T), used("Momentum_stabilization_coefficient", N),               \
      used("Penalty_parameter", N), used("Poisson_ratio", N), used("Viscosity", viscosity_section),                    \
      dropped("Absolute_tolerance", A, electrophysiology),                                                             \
      KeyRule{"Anisotropic_conductivity", V, Use::dropped, electrophysiology, nullptr, true},                          \
      dropped("Feedback_parameter_for_stretch_activated_currents", N, electrophysiology),                              \
      dropped("Isotropic_conductivity", N, electrophysiology), dropped("Maximum_iterations", C, electrophysiology),    \
      dropped("Myocardial_zone", T, electrophysiology), dropped("ODE_solver", T, electrophysiology),                   \
      dropped("Relative_tolerance", A, electrophysiology), dropped("Time_step_for_integration", N, electrophysiology), \
      KeyRule{"Conductivity", V, Use::refused, "heat or electric current", nullptr, true},                             \
      refused("Electrophysiology_model", T, "electrophysiology"),                                                      \
      refused("Fluid_density", N, "the coupled momentum method"), refused("Force_x", N, body_force),                   \
      refused("Force_y", N, body_force), refused("Force_z", N, body_force),                                            \
      refused("Inverse_darcy_permeability", N, "flow through a porous medium"),                                        \
      refused("Mass_damping", N, "damping of the wall in proportion to its mass"),                                     \
      refused("Shell_thickness", N, "shells"), refused("Solid_density", N, "the coupled momentum method"),             \
      refused("Source_term", N, "sources of heat"), refused_section("Active_stress", active),                          \
      refused_section("Fiber_reinforcement_stress", active), refused_section("Directional_distribution", active),      \
      refused_section("Stimulus", "electrophysiology"), refused_section("TTP", "electrophysiology"),                   \
      refused_section("BO", "electrophysiology"), refused_section("AP", "electrophysiology"),                          \
      refused_section("FN", "electrophysiology")

constexpr auto domain_keys = std::to_array<KeyRule>({TUNICA_DOMAIN_KEYS});
constexpr SectionRule domain_section{domain_keys};

// --- conditions ---------------------------------------------------------------------------------------------------

constexpr auto rcr_keys = std::to_array<KeyRule>({
    used("Capacitance", N),
    used("Distal_pressure", N),
    used("Distal_resistance", N),
    used("Initial_pressure", N),
    used("Proximal_resistance", N),
});
constexpr SectionRule rcr_section{rcr_keys};

constexpr auto coupling_keys = std::to_array<KeyRule>({
    used("svZeroDSolver_block", T),
    dropped("Relax_factor", N, "outlets are coupled implicitly"),
    refused("Chamber_cap_surface", P, "a chamber that is closed by a cap surface"),
    refused("Ramp_steps", I, "an outlet whose pressure is ramped"),
    dropped("Ramp_ref_pressure", N, "belongs to Ramp_steps"),
    refused("svOneDSolver_input_file", P, "one-dimensional vessels at an outlet"),
});
constexpr SectionRule coupling_section{coupling_keys};

constexpr auto condition_keys = std::to_array<KeyRule>({
    used("Apply_along_normal_direction", F),
    used("Bct_file_path", P),
    used("Coupling_interface", coupling_section),
    used("Damping", N),
    used("Distal_pressure", N),
    used("Effective_direction", X),
    used("Follower_pressure_load", F),
    used("Fourier_coefficients_file_path", P),
    used("Impose_flux", F),
    used("Impose_on_state_variable_integral", F),
    used("Profile", T),
    used("RCR_values", rcr_section),
    used("Ramp_function", F),
    used("Spatial_profile_file_path", P),
    used("Spatial_values_file_path", P),
    used("Stiffness", N),
    used("Temporal_and_spatial_values_file_path", P),
    used("Temporal_values_file_path", P),
    used("Time_dependence", T),
    used("Traction_multiplier", N),
    used("Traction_values_file_path", P),
    used("Type", T),
    used("Undeforming_neu_face", F),
    used("Value", V),
    used("Zero_out_perimeter", F),
    used(bct_modes, I),
    used(bct_period, N),
    dropped("Penalty_parameter", N, "belongs to Weakly_applied"),
    dropped("Penalty_parameter_normal", N, "belongs to Weakly_applied"),
    dropped("Penalty_parameter_tangential", N, "belongs to Weakly_applied"),
    dropped("Resistance", N, "belongs to valves of type RIS0D"),
    refused("CST_shell_bc_type", T, "shells"),
    refused("Initial_displacements_file_path", P, "the coupled momentum method"),
    refused("Prestress_file_path", P, "the coupled momentum method"),
    refused("Weakly_applied", F,
            "no-slip that holds weakly, by a penalty; without this key the face gets `no_slip`, which holds at every "
            "node"),
});
constexpr SectionRule condition_section{condition_keys};

constexpr auto body_force_keys = std::to_array<KeyRule>({
    refused("Fourier_coefficients_file_path", P, body_force),
    refused("Ramp_function", F, body_force),
    refused("Spatial_values_file_path", P, body_force),
    refused("Temporal_and_spatial_values_file_path", P, body_force),
    refused("Temporal_values_file_path", P, body_force),
    dropped("Time_dependence", T, "belongs to a body force"),
    dropped("Type", T, "belongs to a body force"),
    refused("Value", V, body_force),
});
constexpr SectionRule body_force_section{body_force_keys};

// --- equations ----------------------------------------------------------------------------------------------------

constexpr const char* own_solver = "tunica has its own linear solver and preconditioner";

constexpr auto linear_algebra_keys = std::to_array<KeyRule>({
    dropped("Assembly", T, own_solver),
    dropped("Configuration_file", P, own_solver),
    dropped("Preconditioner", T, own_solver),
});
constexpr SectionRule linear_algebra_section{linear_algebra_keys};

constexpr auto solver_keys = std::to_array<KeyRule>({
    used("Linear_algebra", linear_algebra_section),
    dropped("Absolute_tolerance", A, own_solver),
    dropped("Krylov_space_dimension", C, own_solver),
    dropped("Max_iterations", C, own_solver),
    dropped("NS_CG_max_iterations", C, own_solver),
    dropped("NS_CG_tolerance", A, own_solver),
    dropped("NS_GM_max_iterations", C, own_solver),
    dropped("NS_GM_tolerance", A, own_solver),
    dropped("Preconditioner", T, own_solver),
    dropped("Tolerance", A, own_solver),
    dropped("Use_Trilinos_for_assembly", F, own_solver),
});
constexpr SectionRule solver_section{solver_keys};

constexpr const char* own_output = "tunica writes its own selection of fields and histories";

constexpr auto output_keys(Kind kind) {
  return std::to_array<KeyRule>({
      dropped("Absolute_velocity", kind, own_output),
      dropped("Acceleration", kind, own_output),
      dropped("Action_potential", kind, own_output),
      dropped("Active_tension_fibers", kind, own_output),
      dropped("Active_tension_normal", kind, own_output),
      dropped("Active_tension_sheets", kind, own_output),
      dropped("Area", kind, own_output),
      dropped("CG_Strain", kind, own_output),
      dropped("CG_Strain_Trace", kind, own_output),
      dropped("Cauchy_stress", kind, own_output),
      dropped("Def_grad", kind, own_output),
      dropped("Displacement", kind, own_output),
      dropped("Divergence", kind, own_output),
      dropped("Energy_flux", kind, own_output),
      dropped("Fiber_alignment", kind, own_output),
      dropped("Fiber_direction", kind, own_output),
      dropped("Fiber_shortening", kind, own_output),
      dropped("Fiber_stretch", kind, own_output),
      dropped("Fiber_stretch_rate", kind, own_output),
      dropped("Heat_flux", kind, own_output),
      dropped("Ionic_state_variables", kind, own_output),
      dropped("Jacobian", kind, own_output),
      dropped("Membrane_potential", kind, own_output),
      dropped("Pressure", kind, own_output),
      dropped("Strain", kind, own_output),
      dropped("Strain_invariants", kind, own_output),
      dropped("Stress", kind, own_output),
      dropped("Temperature", kind, own_output),
      dropped("Traction", kind, own_output),
      dropped("Velocity", kind, own_output),
      dropped("Viscosity", kind, own_output),
      dropped("VonMises_stress", kind, own_output),
      dropped("Volume", kind, own_output),
      dropped("Vortex", kind, own_output),
      dropped("Vorticity", kind, own_output),
      dropped("WSS", kind, own_output),
  });
}
constexpr auto outputs = output_keys(F), aliases = output_keys(T);
constexpr SectionRule alias_section{aliases};  // of `Output type="Alias"`, whose values are names
constexpr SectionRule output_section{outputs, false, "Alias", &alias_section};

constexpr auto zerod_keys = std::to_array<KeyRule>({
    used("Configuration_file", P),
    dropped("Coupling_type", T, "outlets are coupled implicitly"),
    dropped("Initial_flows", N, "a run starts at rest"),
    used("Initial_pressures", N),
    dropped("Shared_library", P, "tunica has these outlets built in"),
});
constexpr SectionRule zerod_section{zerod_keys};

constexpr auto equation_keys = std::to_array<KeyRule>({
    TUNICA_DOMAIN_KEYS,
    used("Add_BC", condition_section, true),
    used("Add_BF", body_force_section, true),
    used("Domain", domain_section, true),
    used("LS", solver_section),
    used("Max_iterations", C),
    used("Output", output_section, true),
    used("Initialize_RCR_from_flow", F),
    used("Prestress", F),
    used("Tolerance", A),
    used("Use_taylor_hood_type_basis", F),
    used("svZeroDSolver_interface", zerod_section),
    dropped("Coupled", F, "equations are solved together"),
    dropped("Explicit_geometric_coupling", F, "the mesh follows the wall within the step"),
    dropped("Min_iterations", C, "a step ends when it has converged"),
    refused("Initialize", T, "the coupled momentum method"),
    refused_section("Couple_to_cplBC", "cplBC's zero-dimensional models"),
    refused_section("Couple_to_genBC", "genBC's zero-dimensional models"),
    refused_section("ECGLeads", "electrophysiology"),
    refused_section("Remesher", "remeshing during a run"),
    refused_section("Variable_wall_properties", "the coupled momentum method"),
    refused_section("svOneDSolver_interface", "one-dimensional vessels at an outlet"),
});
#undef TUNICA_DOMAIN_KEYS
constexpr SectionRule equation_section{equation_keys};

const auto file_keys = std::to_array<KeyRule>({
    used(svpre_commands, svpre_section),
    used(svsolver_settings, svsolver_section),
    used("GeneralSimulationParameters", general_section),
    used("Add_mesh", mesh_section, true),
    used("Add_projection", projection_section, true),
    used("Add_equation", equation_section, true),
    refused_section("Add_RIS_projection", "valves as resistive surfaces"),
    refused_section("Add_URIS_mesh", "valves as unfitted resistive surfaces"),
    refused_section("Contact", "contact"),
    refused_section("Precomputed_solution", "a flow that is given at all times"),
});

}  // namespace

const SectionRule whole_file{file_keys};

}  // namespace tunica::peer_cases
