#include "aeolian_twin/splash/study_files.hpp"

#include <cmath>
#include <limits>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_twin/splash/study_quantities.hpp"
#include "aeolian_twin/splash/thesis_tables.hpp"

namespace aeolian {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Lines of comma-separated values.
class Lines {
 public:
  explicit Lines(const std::string& header) : text_(header + "\n") {}

  Lines& operator<<(double value) {
    separate();
    if (!std::isnan(value)) append_number(text_, value);
    return *this;
  }
  Lines& operator<<(const std::string& word) {
    separate();
    text_ += word;
    return *this;
  }
  void end() {
    text_ += '\n';
    begun_ = false;
  }
  const std::string& text() const { return text_; }

 private:
  void separate() {
    if (begun_) text_ += ',';
    begun_ = true;
  }
  std::string text_;
  bool begun_ = false;
};

}  // namespace

void write_events_csv(const std::vector<StudyPoint>& points, const std::string& path) {
  Lines lines(
      "point,impact,bed_kind,speed_m_s,angle_deg,size_ratio,roughness,along_m,across_m,target,target_kind,"
      "normal_angle_deg,approach_m_s,departure_m_s,grains_struck,effective_mass,rebound_x_m_s,rebound_y_m_s,"
      "rebound_z_m_s,rebound_spin_rad_s,rebound_time_s,ejecta,reptation_m");
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (const ImpactOutcome& o : points[p].outcomes) {
      lines << static_cast<double>(p) << o.number << static_cast<double>(points[p].kind) << o.shot.speed
            << o.shot.angle / degree << o.shot.size_ratio << points[p].roughness << o.shot.along
            << o.shot.across;
      if (o.contact)
        lines << o.contact->target << name_of(o.contact->step) << o.contact->normal_angle / degree
              << o.contact->approach << o.contact->departure << o.contact->struck
              << o.contact->effective_mass;
      else
        lines << unknown << "" << unknown << unknown << unknown << unknown << unknown;
      if (o.rebound)
        lines << o.rebound->velocity.x() << o.rebound->velocity.y() << o.rebound->velocity.z()
              << o.rebound->spin << o.rebound->time;
      else
        lines << unknown << unknown << unknown << unknown << unknown;
      double reptation = 0;
      for (const RisenGrain& grain : o.ejecta) reptation += ballistic_hop(grain.velocity);
      lines << static_cast<double>(o.ejecta.size()) << reptation;
      lines.end();
    }
  }
  write_text_atomically(path, lines.text());
}

void write_ejecta_csv(const std::vector<StudyPoint>& points, const std::string& path) {
  Lines lines(
      "point,impact,grain,kind,layer,radius_m,time_s,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s,spin_rad_s,"
      "origin_x_m,origin_y_m,origin_z_m");
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const ImpactOutcome& o : points[p].outcomes)
      for (const RisenGrain& g : o.ejecta) {
        lines << static_cast<double>(p) << o.number << g.grain << name_of(g.kind) << g.layer << g.radius
              << g.time << g.velocity.x() << g.velocity.y() << g.velocity.z() << g.spin << g.origin.x()
              << g.origin.y() << g.origin.z();
        lines.end();
      }
  write_text_atomically(path, lines.text());
}

void write_summary_csv(const StudySettings& study, const std::vector<StudyPoint>& points,
                       const std::string& path) {
  Lines lines(
      "point,bed_kind,speed_m_s,angle_deg,size_ratio,roughness,impacts,quantity,mean,half_width,standard_"
      "error,"
      "count,thesis_mean,thesis_half_width");
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const Quantity& quantity : quantities(points[p].statistics)) {
      const StudyPoint& point = points[p];
      lines << static_cast<double>(p) << static_cast<double>(point.kind) << point.speed
            << point.angle / degree << point.size_ratio << point.roughness << point.statistics.impacts
            << quantity.name << quantity.value.mean << quantity.value.half_width << quantity.value.error
            << quantity.value.count;
      const auto thesis = printed_value(study.thesis_case, quantity.name);
      lines << (thesis ? thesis->mean : unknown) << (thesis ? thesis->half_width : unknown);
      lines.end();
    }
  write_text_atomically(path, lines.text());
}

template <int Dim>
void write_beds_csv(const StudyBeds<Dim>& beds, const std::string& path) {
  Lines lines(
      "bed_kind,bed,grains,packing_fraction,coordination_number,kinetic_energy_mgd,overlap_energy_mgd,"
      "roughness_brinks_per_diameter,mean_surface_m,top_m");
  for (std::size_t kind = 0; kind < beds.kinds.size(); ++kind)
    for (std::size_t i = 0; i < beds.kinds[kind].size(); ++i) {
      const Bed<Dim>& bed = beds.kinds[kind][i];
      const BedState& s = bed.state;
      lines << static_cast<double>(kind) << static_cast<double>(i) << s.grains << s.packing_fraction
            << s.coordination << s.kinetic_energy << s.overlap_energy << s.roughness
            << bed.surface.mean_height() << bed.surface.top();
      lines.end();
    }
  write_text_atomically(path, lines.text());
}

template void write_beds_csv(const StudyBeds<2>&, const std::string&);
template void write_beds_csv(const StudyBeds<3>&, const std::string&);

}  // namespace aeolian
