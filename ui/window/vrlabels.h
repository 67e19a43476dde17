// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/handinput.h"

#include <QtWidgets/QLabel>

#include <string_view>

namespace ps {

/// "1 : 4.0" of a scene that is a quarter as large as it truly is, 0.25.
QString scaleText(double scale);

/// What the parts of a hand's controller do, as a small panel beside it; or how large the scene is that it carries.
class VrLabels : public QLabel {
  Q_OBJECT
 public:
  VrLabels();
  /// Another controller; none ("") has no labels. The size follows.
  void setProfile(std::string_view profile, size_t hand, const vr::HandRoles& roles);
  /// Of the scene that hands carry, of its true size, instead of that; 0: they carry none.
  void setScale(double scale);
  bool any() const { return !text().isEmpty(); }
  bool showsScale() const { return !m_scale.isEmpty(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void showRows();

  QString m_scale;
  std::string_view m_profile;  ///< of a table that stays
  size_t m_hand = vr::kLeft;
  vr::HandRoles m_roles;
};

}  // namespace ps
