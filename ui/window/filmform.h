// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/window/runform.h"

namespace ps {

class Viewport;

/// The recorded run as a film or as pictures, as the view shows it now.
class FilmForm : public RunForm {
  Q_OBJECT
 public:
  /// `view`: nullptr where there is none; then as the project says.
  FilmForm(Session& session, const Viewport* view);

 protected:
  QString suggestedPlace() const override;
  QString choosePlace() override;
  QString summary() const override;
  QString fileNames() const override;
  bool isPossible() const override;
  void begin() override;

 private:
  bool film() const;
  PictureSize size() const;
  /// "in the colours of now", or that those frames have no values for them.
  QString colours() const;

  const Viewport* m_view;
  QComboBox *m_format, *m_size;
  bool m_hasFfmpeg;
};

}  // namespace ps
