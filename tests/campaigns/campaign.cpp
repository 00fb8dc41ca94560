// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/campaign.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

namespace flexneck::campaigns {
namespace {

std::optional<std::string> judged(const Judgement& judge, Case& drawn) {
  try {
    return judge(drawn);
  } catch (const std::exception& error) {
    return std::string("ended by an exception: ") + error.what();
  }
}

Case draw(const std::string& seed, std::uint64_t number, const std::string& out) {
  std::seed_seq mixed(seed.begin(), seed.end());
  std::mt19937_64 base(mixed);
  return {number, std::mt19937_64(base() ^ (number * 0x9e3779b97f4a7c15ULL)), out, false};
}

}  // namespace

int run(int argc, char** argv, const Judgement& judge) {
  std::map<std::string, std::string> given{
      {"--seed", "1"}, {"--runs", "100"}, {"--out", "."}, {"--only", ""}};
  for (int k = 1; k < argc; k += 2) {
    if (given.count(argv[k]) == 0 || k + 1 == argc) {
      std::cerr << argv[0]
                << ": expected --seed TEXT --runs N --out FOLDER [--only NUMBER], found '"
                << argv[k] << "'\n";
      return 2;
    }
    given[argv[k]] = argv[k + 1];
  }
  const std::string& only = given["--only"];
  const std::uint64_t first = only.empty() ? 0 : std::stoull(only);
  const std::uint64_t end = only.empty() ? std::stoull(given["--runs"]) : first + 1;
  const std::filesystem::path folder = given["--out"];
  std::filesystem::create_directories(folder);
  std::ofstream kept(folder / "findings.txt");
  std::uint64_t findings = 0;
  std::uint64_t refused = 0;
  for (std::uint64_t number = first; number < end; ++number) {
    Case drawn = draw(given["--seed"], number, folder);
    const auto finding = judged(judge, drawn);
    if (drawn.was_refused) ++refused;
    if (!finding) continue;
    ++findings;
    std::cout << number << ": " << *finding << std::endl;
    kept << number << ": " << *finding << std::endl;
  }
  std::cout << findings << " findings and " << refused << " refusals in " << end - first
            << " cases\n";
  return findings == 0 ? 0 : 1;
}

}  // namespace flexneck::campaigns
