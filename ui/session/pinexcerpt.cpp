// SPDX-License-Identifier: Apache-2.0
#include "ui/session/pinexcerpt.h"

#include "core/scene/pose.h"
#include "ui/document/pinaddress.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>

namespace ps {
namespace {

constexpr const char *kPins = "pins", *kLeast = "minimum", *kMost = "maximum";
constexpr double kFlat = 4, kLayers = 2;  ///< of particles

const Body* bodyOf(const Project& project, const std::string& id) {
  const auto found =
      std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& body) { return body.id == id; });
  return found == project.bodies.end() ? nullptr : &*found;
}

Region shifted(Region box, const Vector3& way) {
  box.minimum += way;
  box.maximum += way;
  return box;
}

QJsonArray arrayOf(const Vector3& place) { return {place.x(), place.y(), place.z()}; }

std::optional<Vector3> placeIn(const QJsonValue& value) {
  const QJsonArray list = value.toArray();
  if (list.size() != 3) return std::nullopt;
  Vector3 place;
  for (int a = 0; a < 3; ++a) {
    if (!list[a].isDouble()) return std::nullopt;
    place[a] = list[a].toDouble();
  }
  return place;
}

bool same(const Region& a, const Region& b) {
  return a.minimum.isApprox(b.minimum, 1e-6) && a.maximum.isApprox(b.maximum, 1e-6);
}

}  // namespace

std::vector<Region> pinsOf(const Project& project, const std::vector<SelectedItem>& items) {
  std::vector<Region> pins;
  for (const SelectedItem& item : items) {
    const Region* pin = item.kind == OutlineKind::Pin ? findPin(project, item.id) : nullptr;
    if (pin) pins.push_back(shifted(*pin, -boundsOf(*bodyOf(project, PinAddress::parse(item.id)->body)).middle()));
  }
  return pins;
}

std::string textOfPins(const std::vector<Region>& pins) {
  QJsonArray list;
  for (const Region& pin : pins)
    list.append(
        QJsonObject{{QLatin1String(kLeast), arrayOf(pin.minimum)}, {QLatin1String(kMost), arrayOf(pin.maximum)}});
  return QJsonDocument(QJsonObject{{QLatin1String(kPins), list}}).toJson().toStdString();
}

std::optional<std::vector<Region>> pinsIn(const std::string& text) {
  const QJsonObject all = QJsonDocument::fromJson(QByteArray::fromStdString(text)).object();
  const QJsonArray list = all.value(QLatin1String(kPins)).toArray();
  if (list.isEmpty()) return std::nullopt;
  std::vector<Region> pins;
  for (const QJsonValue& each : list) {
    const auto least = placeIn(each[QLatin1String(kLeast)]), most = placeIn(each[QLatin1String(kMost)]);
    if (!least || !most || (most->array() < least->array()).any()) return std::nullopt;
    pins.push_back({*least, *most});
  }
  return pins;
}

BodyPins withPins(const Body& body, const std::vector<Region>& pins) {
  BodyPins held{body.id, body.pins};
  const Vector3 middle = boundsOf(body).middle();
  for (const Region& pin : pins) {
    Region box = shifted(pin, middle);
    const auto taken = [&] {
      return std::any_of(held.boxes.begin(), held.boxes.end(), [&](const Region& other) { return same(other, box); });
    };
    const double wide = pin.maximum.x() - pin.minimum.x();
    while (wide > 0 && taken()) box = shifted(box, Vector3(wide, 0, 0));
    held.boxes.push_back(box);
  }
  return held;
}

std::vector<BodyPins> withoutPins(const Project& project, const std::vector<SelectedItem>& items) {
  std::vector<BodyPins> left;
  for (const Body& body : project.bodies) {
    BodyPins held{body.id, {}};
    for (size_t k = 0; k < body.pins.size(); ++k) {
      const SelectedItem pin{OutlineKind::Pin, PinAddress{body.id, k}.text()};
      if (std::find(items.begin(), items.end(), pin) == items.end()) held.boxes.push_back(body.pins[k]);
    }
    if (held.boxes.size() < body.pins.size()) left.push_back(std::move(held));
  }
  return left;
}

Region firstPin(const Body& body, double spacing) {
  const Vector3 half = boundsOf(body).size() / 2 + Vector3::Constant(spacing / 2);
  Region pin{-half, half};
  if (2 * half.y() > kFlat * spacing)
    pin.minimum.y() = std::max(-half.y(), half.y() - kLayers * spacing);
  else
    pin.maximum.x() = std::min(half.x(), kLayers * spacing - half.x());
  return pin;
}

}  // namespace ps
