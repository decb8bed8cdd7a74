#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string>

#include "io/text/content_hash.h"

namespace menger::tests {

/// The text of paper/demo/study.toml in archives of version 3.
inline constexpr const char* demo_study_of_version_3 = R"(seed = 1
[population]
survivors = 15
mutants = 15
newcomers = 1
[genome]
encoding = "fractal"
activations = "paper"
output_function = "kept"
expression = "every-consumer"
axes = "xyz"
largest_tries = 1500
[body]
cell_edge_m = 0.01
levels = [1, 2]
smallest_body_cells = 3
smallest_arranged_body_cells = 27
disconnected = "reject"
[evaluation]
duration_s = 2
objective = "body-lengths"
duplicates = "archived-result"
pruning = true
[materials]
poissons_ratio = 0
[materials.material_1]
youngs_modulus_Pa = 10000
density_kg_m3 = 10
static_friction = 1
kinetic_friction = 0.5
[materials.material_2]
youngs_modulus_Pa = 10000
density_kg_m3 = 10
static_friction = 1
kinetic_friction = 0.5
[damping]
bond = 1
collision = 0.8
global = 0.01
[environment]
gravity_m_s2 = 9.81
floor = true
stop_rotation_in_static_friction = true
[actuation]
mode = "antiphase"
amplitude = 0.144714
period_s = 0.2
material_phase = [0, 0.5]
wave_axis = "y"
wave_periods_per_body = -1
wave_over_gaps = false
[collisions]
exclusion_depth = 1
[integration]
time_step_fraction = 0.9
damping = "increments"
number = "float64"
single_precision_rest_lengths = false
[limits]
speed_fraction = 0.2
strain = 1
)";

/// The same for a search of silicone robots: level 1, castable bodies that stand, 0.05 s of which the first 0.01 s are left out,
/// two survivors and two mutants.
inline constexpr const char* silicone_study_of_version_3 = R"(seed = 1
[population]
survivors = 2
mutants = 2
newcomers = 1
[genome]
encoding = "fractal"
activations = "paper"
output_function = "kept"
expression = "every-consumer"
axes = "xyz"
largest_tries = 1500
[body]
cell_edge_m = 0.01
levels = [1]
smallest_body_cells = 3
smallest_arranged_body_cells = 27
disconnected = "reject"
castable = true
[evaluation]
duration_s = 0.05
measure_from_s = 0.01
stand = true
objective = "body-lengths"
duplicates = "archived-result"
pruning = true
[materials]
poissons_ratio = 0
[materials.material_1]
static_friction = 1
kinetic_friction = 0.5
[materials.material_2]
static_friction = 1
kinetic_friction = 0.5
[damping]
collision = 0.8
global = 0.01
[environment]
gravity_m_s2 = 9.81
floor = true
[actuation]
mode = "in_phase"
period_s = 0.3333333333333333
ramp_s = 0.3333333333333333
material_phase = [0, 0.5]
wave_axis = "y"
wave_periods_per_body = -1
wave_over_gaps = false
[collisions]
exclusion_depth = 1
[integration]
time_step_fraction = 0.9
damping = "increments"
number = "float64"
single_precision_rest_lengths = false
[limits]
speed_fraction = 0.2
strain = 1
[surrogate]
pressure_Pa = [0, 6000]
chambers = "single"
outside_range = "warn"
[surrogate.parameters.holds_for]
silicone = "Dragon Skin 10"
law = "name = \"neo_hookean\", shear_modulus_Pa = 86677"
cell_edge_m = 0.01
wall_thickness_m = 0.002
voxels_per_cell = 1
chambers = "single"
[surrogate.parameters.validity]
lowest_pressure_gap_1_Pa = [0, -1539.6002125, -2919.9314375000004, -6604.354015000002, -5147.0427793750005, -8085.555598750001, -31010.99910781249]
lowest_pressure_gap_2_Pa = [0, -1539.6002125, -2919.9314375000004, -6604.354015000002, -5147.0427793750005, -8085.555598750001, -31010.99910781249]
lowest_pressure_gap_3_Pa = [-1997.9048500000004, -1997.9048500000004, -2919.9314375000004, -6604.354015000002, -5147.0427793750005, -8085.555598750001, -31010.99910781249]
highest_pressure_Pa = [8990.310933122593, 15573.202185724149, 18366.354059296387, 23005.62988658612, 23679.96235205714, 25973.381498048115, 34818.686103946]
lowest_joint_pressure_Pa = -8085.555598750001
highest_joint_pressure_Pa = 25973.381498048115
smallest_strain = -0.1412573012116909
largest_strain = 0.2186642283760334
longest_body_cells = 3
longest_aggregate_modules = 2
[surrogate.parameters.mass]
density_kg_m3 = 1070
[surrogate.parameters.stiffness]
axial_Pa = [5319.633589867363, 53196.33589867362, 95753.40461761253, 106392.67179734724, 106392.67179734728, 138310.47333655145, 170228.27487575563]
bending_Pa = [7287.632778836312, 72876.32778836311, 131177.3900190536, 145752.65557672622, 145752.65557672628, 189478.45224974412, 233204.248922762]
torsion_Pa = [4158.8211441004305, 41588.2114410043, 74858.78059380774, 83176.4228820086, 83176.42288200863, 108129.34974661119, 133082.27661121378]
shear_compliance_per_Pa = [0.0008273677517092, 8.273677517092001e-05, 4.596487509495556e-05, 4.1368387585460004e-05, 4.136838758545999e-05, 3.18218366042e-05, 2.58552422409125e-05]
lateral_coupling = 0.36226436637950077
[surrogate.parameters.joint]
axial_factor = 1
bending_factor = 1
torsion_factor = 1
[surrogate.parameters.extension]
slope_per_Pa = [5.826859848387339e-06, 4.756620284397828e-06, 2.1140534597323693e-06, 1.7837326066491862e-06, 1.7837326066491852e-06, 1.0976816040918066e-06, 6.688997274934446e-07]
pressure_softening_per_Pa = [1.876784056094049e-05, 1.876784056094049e-05, 1.876784056094049e-05, 1.876784056094049e-05, 1.876784056094049e-05, 1.876784056094049e-05, 1.876784056094049e-05]
vacuum_softening_per_Pa = [8.994270289392063e-06, 8.994270289392063e-06, 8.994270289392063e-06, 8.994270289392063e-06, 8.994270289392063e-06, 8.994270289392063e-06, 8.994270289392063e-06]
fading_share = [0, 0, 0, 0, 0, 0, 0]
fading_per_Pa = [0, 0, 0, 0, 0, 0, 0]
[surrogate.parameters.bulge]
slope_per_Pa = [0.0003860902589281813, 0.00015349418758102973, 2.7031525522090118e-05, 6.316669596471982e-06, 1.8026496060041e-06, 1.4075302000077268e-06, 4.210639936855943e-07]
pressure_softening_per_Pa = [1.6298077877043568e-05, 1.6298077877043568e-05, 1.6298077877043568e-05, 1.6298077877043568e-05, 1.6298077877043568e-05, 1.6298077877043568e-05, 1.6298077877043568e-05]
vacuum_softening_per_Pa = [8.775119479509455e-06, 8.775119479509455e-06, 8.775119479509455e-06, 8.775119479509455e-06, 8.775119479509455e-06, 8.775119479509455e-06, 8.775119479509455e-06]
fading_share = [0.8697173114982049, 0.9279186599345064, 0.8663532197951952, 0.885234280350301, 0, 0.4173860786851788, 1]
fading_per_Pa = [0.0027864404993764237, 0.001084211036077915, 0.0003972263395553213, 7.3138350099822e-06, 2.8720210665464227e-07, 0.00287202106654642, 4.663302722921396e-06]
peak_ratio = [1, 1.501379907703253, 3.3805963113251245, 1, 1.8437096969488027, 1, 6.705082785981404]
[surrogate.parameters.ground]
stiffness_N_per_m = 4409.007942397186
[surrogate.parameters.damping]
bond_ratio = 1
measured = false
)";

/// Changes an archive to what version 3 wrote.
/// @param study text of the study as that version wrote it
inline void make_earlier(const std::filesystem::path& archive, const std::string& study) {
  SQLite::Database database(archive.string(), SQLite::OPEN_READWRITE);
  SQLite::Statement update(database, "UPDATE study SET resolved = ?, hash = ?");
  update.bind(1, study);
  update.bind(2, io::content_hash(study));
  update.exec();
  for (const char* table : {"evaluation", "step_check"}) {
    if (database.tableExists(table)) database.exec("UPDATE " + std::string(table) + " SET physics_hash = 'of the text of then'");
  }
  if (database.tableExists("left_out")) database.exec("UPDATE left_out SET decided_by_hash = 'of the text of then'");
  database.exec("PRAGMA user_version = 3");
}

}  // namespace menger::tests
