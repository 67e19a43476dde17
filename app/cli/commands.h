// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>

namespace ps::cli {

// One function per command: its arguments without the command's name, its exit code. InputError means 2, any other
// exception 1.
using CommandArguments = std::span<const std::string>;

int simulateCommand(CommandArguments arguments);
int renderCommand(CommandArguments arguments);
int exportCommand(CommandArguments arguments);
int benchCommand(CommandArguments arguments);
int validateCommand(CommandArguments arguments);
int schemaCommand(CommandArguments arguments);
int pluginsCommand(CommandArguments arguments);
int casesCommand(CommandArguments arguments);
int fitCommand(CommandArguments arguments);
int importCommand(CommandArguments arguments);
int soakCommand(CommandArguments arguments);
int shareCommand(CommandArguments arguments);
int redrawCommand(CommandArguments arguments);
int mixCommand(CommandArguments arguments);

std::string simulateHelp();
std::string renderHelp();
std::string exportHelp();
std::string benchHelp();
std::string validateHelp();
std::string schemaHelp();
std::string pluginsHelp();
std::string casesHelp();
std::string fitHelp();
std::string importHelp();
std::string soakHelp();
std::string shareHelp();
std::string redrawHelp();
std::string mixHelp();

inline constexpr int kFine = 0, kFailed = 1, kBadInput = 2, kNoReturn = 3;

}  // namespace ps::cli
