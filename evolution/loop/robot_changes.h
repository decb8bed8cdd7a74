#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace menger::evolution {

/// Returns in which keys a robot differs from that of the last finished run of a loop, which its manifest holds:
/// "drive.pressure_Pa [0,2500] -> [0,3000]". Keys without a value on one side are told as "none". Empty if there was no run, or
/// nothing differs.
/// @param manifest of that run; one of another program says nothing @param parameters the robot as it is now, as
/// io::described_text gives it
std::vector<std::string> robot_changes(const std::filesystem::path& manifest, const std::string& parameters);

}  // namespace menger::evolution
