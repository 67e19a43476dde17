// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/address.h"
#include "ui/rows/parameterrow.h"

#include <optional>
#include <string>

namespace ps {

class Document;
class PluginRegistry;

// Rows of panels for the addresses of a document.

/// Whether an address has a declaration and an owner, so that there can be a row of it.
bool hasRow(const Document& document, const Address& address);
/// The row of one address; nothing where there can be none.
std::optional<RowModel> rowModelOf(const Document& document, const Address& address);
/// What bounds the value of a row's address and when it acts, and whether it does nothing as the scene is.
void addRules(RowModel& row, const Document& document, const Address& address);
/// "" or why a value of this address does nothing as the scene is.
QString idleText(const Document& document, const Address& address);
/// Where the installed material's figure comes from; "" where nothing says so.
QString sourceOf(const Document& document, const std::string& material, const char* key);
/// How well the figures of an installed material are known.
QString gradeText(const PluginRegistry* plugins, const std::string& base);

}  // namespace ps
