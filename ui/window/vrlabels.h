// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"

#include <QtWidgets/QLabel>

#include <string_view>

namespace ps {

/// What the parts of a hand's controller do, as a small panel beside it.
class VrLabels : public QLabel {
  Q_OBJECT
 public:
  VrLabels();
  /// Another controller; none ("") has no labels. The size follows.
  void setProfile(std::string_view profile, size_t hand, const vr::HandRoles& roles);
  bool any() const { return !text().isEmpty(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::string_view m_profile;  ///< of a table that stays
  vr::HandRoles m_roles;
};

}  // namespace ps
