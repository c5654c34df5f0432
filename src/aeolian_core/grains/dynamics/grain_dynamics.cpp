#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"

#include "aeolian_core/grains/dynamics/grain_engine.hpp"

namespace aeolian {
namespace {

/// The engine when its lists are up to date, else a copy that is; `copy` holds it.
template <class Engine>
const Engine& prepared(const Engine& engine, std::unique_ptr<Engine>& copy) {
  if (engine.ready()) return engine;
  copy = std::make_unique<Engine>(engine);
  copy->prepare();
  return *copy;
}

}  // namespace

template <int Dim>
GrainDynamics<Dim>::GrainDynamics(const GrainWorld<Dim>& world) : engine_(std::make_unique<Engine>(world)) {}
template <int Dim>
GrainDynamics<Dim>::~GrainDynamics() = default;
template <int Dim>
GrainDynamics<Dim>::GrainDynamics(const GrainDynamics& other)
    : engine_(std::make_unique<Engine>(*other.engine_)) {}
template <int Dim>
GrainDynamics<Dim>& GrainDynamics<Dim>::operator=(const GrainDynamics& other) {
  if (this != &other) engine_ = std::make_unique<Engine>(*other.engine_);
  return *this;
}
template <int Dim>
GrainDynamics<Dim>::GrainDynamics(GrainDynamics&&) noexcept = default;
template <int Dim>
GrainDynamics<Dim>& GrainDynamics<Dim>::operator=(GrainDynamics&&) noexcept = default;

template <int Dim>
const GrainWorld<Dim>& GrainDynamics<Dim>::world() const {
  return engine_->world();
}
template <int Dim>
void GrainDynamics<Dim>::set_world(const GrainWorld<Dim>& world) {
  engine_->set_world(world);
}
template <int Dim>
void GrainDynamics<Dim>::set_threads(int threads) {
  engine_->set_threads(threads);
}

template <int Dim>
int GrainDynamics<Dim>::add(const Vector<Dim>& position, double radius, const Vector<Dim>& velocity,
                            const Spin<Dim>& spin) {
  return engine_->add(position, radius, velocity, spin);
}
template <int Dim>
void GrainDynamics<Dim>::remove(int grain) {
  engine_->remove(grain);
}

template <int Dim>
std::size_t GrainDynamics<Dim>::size() const {
  return engine_->numbers().size();
}
template <int Dim>
const std::vector<int>& GrainDynamics<Dim>::numbers() const {
  return engine_->numbers();
}
template <int Dim>
bool GrainDynamics<Dim>::holds(int grain) const {
  return engine_->holds(grain);
}
template <int Dim>
Vector<Dim> GrainDynamics<Dim>::position(int grain) const {
  return engine_->position(grain);
}
template <int Dim>
Vector<Dim> GrainDynamics<Dim>::velocity(int grain) const {
  return Eigen::Map<const Vector<Dim>>(engine_->record(grain).value + GrainRecord<Dim>::velocity);
}
template <int Dim>
Spin<Dim> GrainDynamics<Dim>::spin(int grain) const {
  return Eigen::Map<const Spin<Dim>>(engine_->record(grain).value + GrainRecord<Dim>::spin);
}
template <int Dim>
double GrainDynamics<Dim>::radius(int grain) const {
  return engine_->record(grain).value[GrainRecord<Dim>::radius];
}
template <int Dim>
double GrainDynamics<Dim>::mass(int grain) const {
  return 1 / engine_->record(grain).value[GrainRecord<Dim>::inverse_mass];
}
template <int Dim>
void GrainDynamics<Dim>::set_motion(int grain, const Vector<Dim>& velocity, const Spin<Dim>& spin) {
  engine_->set_motion(grain, velocity, spin);
}

template <int Dim>
double GrainDynamics<Dim>::time() const {
  return engine_->time();
}
template <int Dim>
double GrainDynamics<Dim>::step(double most) {
  return engine_->step(most);
}
template <int Dim>
void GrainDynamics<Dim>::advance(double duration) {
  engine_->advance(duration);
}

template <int Dim>
std::vector<GrainContact<Dim>> GrainDynamics<Dim>::contacts() const {
  std::unique_ptr<Engine> copy;
  return prepared(*engine_, copy).contacts(-1);
}
template <int Dim>
std::vector<GrainContact<Dim>> GrainDynamics<Dim>::contacts(int grain) const {
  std::unique_ptr<Engine> copy;
  return prepared(*engine_, copy).contacts(grain);
}
template <int Dim>
double GrainDynamics<Dim>::kinetic_energy() const {
  return engine_->kinetic_energy();
}
template <int Dim>
double GrainDynamics<Dim>::potential_energy() const {
  std::unique_ptr<Engine> copy;
  return prepared(*engine_, copy).potential_energy();
}
template <int Dim>
std::size_t GrainDynamics<Dim>::awake() const {
  return engine_->awake();
}
template <int Dim>
std::vector<int> GrainDynamics<Dim>::moving() const {
  return engine_->moving();
}
template <int Dim>
std::size_t GrainDynamics<Dim>::grain_steps() const {
  return engine_->grain_steps();
}

template class GrainDynamics<2>;
template class GrainDynamics<3>;

}  // namespace aeolian
