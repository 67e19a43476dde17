// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtGui/QImage>

class QWidget;

namespace ps {

/// The whole window as an image, the scene and what is painted over it included (QWidget::grab leaves out the latter).
QImage windowImage(QWidget& window);

}  // namespace ps
