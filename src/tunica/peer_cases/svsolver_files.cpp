#include "tunica/peer_cases/svsolver_files.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace fs = std::filesystem;

namespace {

constexpr const char* blanks_of_line = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks_of_line);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks_of_line) - first + 1);
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (auto at = text.find_first_not_of(blanks_of_line); at != std::string_view::npos;) {
    const auto end = std::min(text.find_first_of(blanks_of_line, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = text.find_first_not_of(blanks_of_line, end);
  }
  return words;
}

/// The lines of a file as keys with values, `separator` between them; comments begin with #.
Entry read_lines(const fs::path& path, const char* name, char separator) {
  Entry section{.key = name, .label = {}, .value = {}, .file = path.filename().string(), .line = 1, .section = true};
  const std::string text = text::read(path);
  int line = 0;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const auto end = std::min(text.find('\n', at), text.size());
    auto content = std::string_view(text).substr(at, end - at);
    at = end + 1;
    content = trimmed(content.substr(0, content.find('#')));
    if (content.empty()) continue;
    const auto split = content.find(separator);
    if (split == std::string_view::npos && separator == ':')
      throw InputError(fmt::format("{}:{}", path.string(), line + 1),
                       fmt::format("`{}` has no colon behind its key", text::printable(content)), "write `Key: value`");
    section.entries.push_back(
        {.key = std::string(trimmed(content.substr(0, split))),
         .label = {},
         .value = split == std::string_view::npos ? "" : std::string(trimmed(content.substr(split))),
         .file = section.file,
         .line = line + 1});
    if (separator == ':') section.entries.back().value = trimmed(content.substr(split + 1));
  }
  return section;
}

/// The Windkessel of an outlet in rcrt.dat.
struct Windkessel {
  std::string proximal, capacitance, distal, distal_pressure;
  int line;
};

/// A count of points; then of each surface that count again, Rp, C, Rd and as many lines of time and distal pressure.
std::vector<Windkessel> read_rcrt(const fs::path& path) {
  const auto lines = files::read_lines(path, "restore the file that SimVascular has written");
  std::size_t at = 1;
  const auto next = [&]() -> const files::TextLine& {
    if (at >= lines.size())
      throw InputError(path.string(), "ends within a Windkessel", "restore the file that SimVascular has written");
    return lines[at++];
  };
  std::vector<Windkessel> found;
  while (at < lines.size()) {
    const auto& head = next();
    const auto where = fmt::format("{}:{}", path.string(), head.number);
    const auto count = read_number(trimmed(head.text), Dialect::svsolver);
    if (count.error || count.value < 1 || count.value > 1e6 || count.value != static_cast<int>(count.value))
      throw InputError(where, fmt::format("`{}` is no number of points", text::printable(head.text)),
                       "restore the file that SimVascular has written");
    Windkessel w{
        .proximal = {}, .capacitance = {}, .distal = {}, .distal_pressure = {}, .line = static_cast<int>(head.number)};
    w.proximal = trimmed(next().text);
    w.capacitance = trimmed(next().text);
    w.distal = trimmed(next().text);
    for (int i = 0; i < static_cast<int>(count.value); ++i) {
      const auto& point = next();
      const auto words = words_of(point.text);
      if (words.size() != 2 ||
          (i > 0 && words[1] != w.distal_pressure &&
           read_number(words[1], Dialect::svsolver).value != read_number(w.distal_pressure, Dialect::svsolver).value))
        throw InputError(fmt::format("{}:{}", path.string(), point.number),
                         "asks for what tunica does not have: a distal pressure that changes in time",
                         "give two points, time and distal pressure, with the same pressure");
      if (i == 0) w.distal_pressure = words[1];
    }
    found.push_back(std::move(w));
  }
  return found;
}

class Builder {
 public:
  explicit Builder(const fs::path& presolver)
      : path_(presolver),
        folder_(presolver.parent_path()),
        commands_(read_lines(presolver, svpre_commands, ' ')),
        settings_(read_lines(folder_ / "solver.inp", svsolver_settings, ':')) {}

  Entry root() {
    Entry root = section("", "", commands_);
    root.entries.push_back(general());
    Entry mesh = section("Add_mesh", path_.stem().string(), commands_), equation = equation_of_blood();
    for (const char* key : {"mesh_and_adjncy_vtu", "mesh_vtu"})
      if (const Entry* volume = commands_.find(key); volume != nullptr && mesh.find("Mesh_file_path") == nullptr)
        add(mesh, "Mesh_file_path", volume->value, *volume);
    add_inlets(equation);
    add_walls(equation);
    add_outlets(equation);
    for (const auto& [file, command] : faces_) {
      Entry face = section("Add_face", fs::path(file).stem().string(), *command);
      add(face, "Face_file_path", file, *command);
      mesh.entries.push_back(std::move(face));
    }
    root.entries.push_back(std::move(mesh));
    root.entries.push_back(std::move(equation));
    root.entries.push_back(std::move(commands_));
    root.entries.push_back(std::move(settings_));
    return root;
  }

 private:
  static Entry section(const char* key, std::string label, const Entry& from) {
    return {.key = key, .label = std::move(label), .value = {}, .file = from.file, .line = from.line, .section = true};
  }
  static void add(Entry& to, const char* key, std::string value, const Entry& from) {
    to.entries.push_back({.key = key, .label = {}, .value = std::move(value), .file = from.file, .line = from.line});
  }
  /// Takes a key of solver.inp over, or where there is none a command.
  void take(Entry& to, const char* key, const char* setting, const char* command = nullptr) const {
    const Entry* from = settings_.find(setting);
    if (from == nullptr && command != nullptr) from = commands_.find(command);
    if (from != nullptr) add(to, key, from->value, *from);
  }

  Entry general() const {
    Entry general = section("GeneralSimulationParameters", "", settings_);
    take(general, "Number_of_time_steps", "Number of Timesteps");
    take(general, "Time_step_size", "Time Step Size");
    take(general, "Increment_in_saving_VTK_files", "Number of Timesteps between Restarts");
    take(general, "Increment_in_saving_restart_files", "Number of Timesteps between Restarts");
    const Entry* radius = settings_.find("Time Integration Rho Infinity");
    add(general, "Spectral_radius_of_infinite_time_step", radius != nullptr ? radius->value : "0.5",
        radius != nullptr ? *radius : settings_);
    return general;
  }

  Entry equation_of_blood() const {
    Entry equation = section("Add_equation", "fluid", settings_);
    take(equation, "Density", "Density", "fluid_density");
    Entry viscosity = section("Viscosity", "Constant", settings_);
    take(viscosity, "Value", "Viscosity", "fluid_viscosity");
    if (!viscosity.entries.empty()) viscosity.line = viscosity.entries[0].line;
    equation.entries.push_back(std::move(viscosity));
    take(equation, "Backflow_stabilization_coefficient", "Backflow Stabilization Coefficient");
    take(equation, "Tolerance", "Residual Criteria");
    return equation;
  }

  /// A condition on the face of that file.
  Entry condition(const std::string& file, const char* type, const Entry& command) {
    faces_.emplace(file, &command);
    Entry condition = section("Add_BC", fs::path(file).stem().string(), command);
    add(condition, "Type", type, command);
    return condition;
  }

  /// Every bct_create takes the settings that stand before it.
  void add_inlets(Entry& equation) {
    std::map<std::string, const Entry*> latest;
    bool flipped = false;
    for (const Entry& command : commands_.entries) {
      if (command.key == "bct_flip") flipped = true;
      if (command.key != "bct_create") {
        latest[command.key] = &command;
        continue;
      }
      const auto words = words_of(command.value);
      if (words.size() != 2)
        throw InputError(command.where(), "does not name a face and a file of its flow", "write both");
      Entry inlet = condition(words[0], "Dir", command);
      add(inlet, "Time_dependence", "Unsteady", command);
      add(inlet, "Temporal_values_file_path", words[1], command);
      add(inlet, "Impose_flux", "true", command);
      const Entry* shape = latest["bct_analytical_shape"];
      const std::string name = shape == nullptr ? "parabolic" : shape->value;
      add(inlet, "Profile",
          name == "plug"        ? "Flat"
          : name == "parabolic" ? "Parabolic"
                                : name,
          shape == nullptr ? command : *shape);
      if (flipped)
        throw InputError(command.where(), "asks for what tunica import does not have: a flow whose sign bct_flip turns",
                         "turn the sign of the flow in its file, and remove bct_flip");
      if (const Entry* period = latest["bct_period"]) add(inlet, bct_period, period->value, *period);
      if (const Entry* modes = latest["bct_fourier_mode_number"]) add(inlet, bct_modes, modes->value, *modes);
      equation.entries.push_back(std::move(inlet));
    }
  }

  void add_walls(Entry& equation) {
    for (const Entry* command : commands_.all("noslip_vtp")) {
      Entry wall = condition(command->value, "Dir", *command);
      add(wall, "Value", "0.0", *command);
      equation.entries.push_back(std::move(wall));
    }
  }

  /// Numbers of a list in solver.inp.
  std::vector<std::string> list(const char* key) const {
    const Entry* entry = settings_.find(key);
    return entry == nullptr ? std::vector<std::string>() : words_of(entry->value);
  }

  /// The face of a number that set_surface_id_vtp has given.
  const std::string& face_of(const std::string& number, const char* key) const {
    const auto found = numbers_.find(number);
    if (found == numbers_.end())
      throw InputError(settings_.find(key)->where(),
                       fmt::format("names the surface {}, which no set_surface_id_vtp has", text::printable(number)),
                       "correct the number, or add the command");
    return found->second;
  }

  void add_outlets(Entry& equation) {
    for (const Entry* command : commands_.all("set_surface_id_vtp"))
      if (const auto words = words_of(command->value); words.size() == 2) numbers_[words[1]] = words[0];
    std::map<std::string, Entry> outlets;  // by the file of the face
    for (const char* key : {"zero_pressure_vtp", "pressure_vtp"})
      for (const Entry* command : commands_.all(key)) {
        const auto words = words_of(command->value);
        if (words.empty()) continue;
        Entry outlet = condition(words[0], "Neu", *command);
        add(outlet, "Value", words.size() > 1 ? words[1] : "0.0", *command);
        outlets[words[0]] = std::move(outlet);
      }
    add_resistances(outlets);
    add_windkessels(outlets);
    for (auto& [file, outlet] : outlets) equation.entries.push_back(std::move(outlet));
  }

  /// Puts the outlet in the place of the pressure 0 that marks it for the presolver.
  Entry& replace(std::map<std::string, Entry>& outlets, const std::string& file, const char* key) {
    const Entry& setting = *settings_.find(key);
    if (const auto old = outlets.find(file); old != outlets.end())
      if (const auto p = read_number(old->second.find("Value")->value, Dialect::svsolver); p.error || p.value != 0)
        throw InputError(old->second.where(),
                         fmt::format("gives a pressure to a face that {} of solver.inp gives an outlet", key),
                         "write the pressure 0, and a distal pressure in rcrt.dat");
    return outlets[file] = condition(file, "Neu", setting);
  }

  void add_resistances(std::map<std::string, Entry>& outlets) {
    constexpr const char* key = "List of Resistance Surfaces";
    const auto surfaces = list(key), values = list("Resistance Values");
    if (surfaces.size() != values.size())
      throw InputError(settings_.find(surfaces.empty() ? "Resistance Values" : key)->where(),
                       fmt::format("{} surfaces have {} resistances", surfaces.size(), values.size()),
                       "give each surface one");
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      Entry& outlet = replace(outlets, face_of(surfaces[k], key), key);
      add(outlet, "Time_dependence", "Resistance", *settings_.find(key));
      add(outlet, "Value", values[k], *settings_.find("Resistance Values"));
    }
  }

  void add_windkessels(std::map<std::string, Entry>& outlets) {
    constexpr const char* key = "List of RCR Surfaces";
    const auto surfaces = list(key);
    if (surfaces.empty()) return;
    const fs::path file = folder_ / "rcrt.dat";
    const auto values = read_rcrt(file);
    if (values.size() != surfaces.size())
      throw InputError(
          file.string(),
          fmt::format("holds {} Windkessels, solver.inp lists {} surfaces", values.size(), surfaces.size()),
          "give each surface of `List of RCR Surfaces` one, in that order");
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      Entry& outlet = replace(outlets, face_of(surfaces[k], key), key);
      add(outlet, "Time_dependence", "RCR", *settings_.find(key));
      Entry from{.key = {}, .label = {}, .value = {}, .file = "rcrt.dat", .line = values[k].line};
      Entry rcr = section("RCR_values", "", from);
      add(rcr, "Proximal_resistance", values[k].proximal, from);
      add(rcr, "Capacitance", values[k].capacitance, from);
      add(rcr, "Distal_resistance", values[k].distal, from);
      add(rcr, "Distal_pressure", values[k].distal_pressure, from);
      const Entry* start = commands_.find("initial_pressure");
      add(rcr, "Initial_pressure", start != nullptr ? start->value : "0.0", start != nullptr ? *start : from);
      outlet.entries.push_back(std::move(rcr));
    }
  }

  fs::path path_, folder_;
  Entry commands_, settings_;
  std::map<std::string, const Entry*> faces_;  ///< file, and the command that names it first
  std::map<std::string, std::string> numbers_;
};

}  // namespace

PeerFile read_svsolver(const fs::path& presolver) { return {presolver, Dialect::svsolver, Builder(presolver).root()}; }

}  // namespace tunica::peer_cases
