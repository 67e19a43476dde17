// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/address.h"

#include <QtCore/QString>

#include <functional>

namespace ps {

class Document;

/// A body, wall, tap, drain or material, whatever the key of its address, leaves the scene by `removal`, which is one
/// command. What animates it and the probes that see it alone go with it, in one step of that title.
void takeOut(Document& document, const Address& thing, const QString& title, const std::function<void()>& removal);

}  // namespace ps
