// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"

#include <QtCore/QEvent>

#include <memory>
#include <utility>

namespace ps {

/// Sent to a view: what it shows from now on that is no part of the scene, such as the hands of whoever wears a
/// headset. It is drawn as soon as the view draws again, which leaves the solver its time.
class PropsEvent : public QEvent {
 public:
  explicit PropsEvent(std::shared_ptr<const Props> props) : QEvent(kind()), m_props(std::move(props)) {}
  static Type kind() {
    static const int kKind = registerEventType();
    return static_cast<Type>(kKind);
  }
  const Props& props() const { return *m_props; }

 private:
  std::shared_ptr<const Props> m_props;  ///< never nullptr
};

}  // namespace ps
