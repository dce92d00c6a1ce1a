// One wall element of the distributed mesh in a given state: what outputs and tests look at.
#pragma once

#include "tunica/coupling/state.hpp"
#include "tunica/coupling/wall_model.hpp"
#include "tunica/wall/quadratic_element.hpp"

namespace tunica::coupling {

/// The element with its reference in its fibre frame, displacement, acceleration and pressure. Of a quadratic mesh: the
/// linear element that has its deformation gradient, displacement, pressure and mean prestretch at the centroid.
wall::ElementState<double> wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                        const FieldsView& fields, std::size_t region, std::int32_t element);

/// The same of a state whose displacement and pressure are of one instant: statics, a wall at rest.
wall::ElementState<double> wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                        const State& state, std::size_t region, std::int32_t element);

/// The linear element that stands for it at one of its points of prestress (prestress_points); that of a linear mesh
/// itself.
wall::ElementState<double> wall_point(const distributed::DistributedMesh& mesh, const WallModel& model,
                                      const State& state, std::size_t region, std::int32_t element, int point);

/// The element of a quadratic mesh in the imaged shape with displacement, acceleration and pressure of `fields`.
wall::quadratic::ElementState<double> quadratic_wall_element(const distributed::DistributedMesh& mesh,
                                                             const WallModel& model, const FieldsView& fields,
                                                             std::size_t region, std::int32_t element);

/// Cauchy stress of wall_element() with the prestress, the mean of its points, in global axes [Pa], Voigt 11 22 33 12
/// 23 13.
wall::Symmetric<double> cauchy_stress(const WallModel& model, std::size_t region, std::int32_t element,
                                      const wall::ElementState<double>& state);

/// The same of wall_point().
wall::Symmetric<double> point_cauchy_stress(const WallModel& model, std::size_t region, std::int32_t element, int point,
                                            const wall::ElementState<double>& state);

}  // namespace tunica::coupling
