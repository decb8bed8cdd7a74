#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/offspring.h"
#include "evolution/study/study_file.h"

namespace menger::tests {

/// Returns the search of silicone robots that comes with menger, with its calibrated parameters. Displacement is measured from
/// the start, because tests are shorter than the time that this search leaves out.
inline evolution::Study silicone_study() {
  evolution::Study study = evolution::read_study(MENGER_SOURCE_DIR "/paper/silicone/study.toml");
  study.measure_from_s = 0.0;
  study.search.stand = false;
  return study;
}

/// Makes an archive of a study with designs of these bodies (27 digits each). The first has the largest fitness.
inline void make_archive(const std::filesystem::path& file, const evolution::Study& study,
                         const std::vector<std::string>& bodies) {
  evolution::RunArchive archive = evolution::RunArchive::open(file, evolution::identity_text(study), study.search.generations);
  std::vector<evolution::Individual> born;
  std::vector<evolution::PoolMember> members;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    evolution::RandomStream random(n, "genomes");
    evolution::Individual individual;
    individual.id = n;
    individual.genome = evolution::random_offspring(study.search.offspring, random).genome;
    individual.phenotype.body = meshes::Polycube::from_digits(3, 3, 3, bodies[n]);
    born.push_back(individual);
    const double fitness = 1.0 - 0.125 * static_cast<double>(n);
    members.push_back({n, 0, fitness, evolution::Knowledge::evaluated, std::nullopt, n});
  }
  archive.add_generation({0, 0, 0, 0, 0.0, "a", "b"}, born, members);
}

}  // namespace menger::tests
