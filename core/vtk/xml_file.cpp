#include <vtk/xml_file.hpp>

#include <bit>

namespace hyperlattice::vtk {

std::string_view real_type(Digits digits) {
  return digits == Digits::single_precision ? "Float32" : "Float64";
}

void encode(const Snapshot& snapshot, const PackingOptions& options, std::span<const double> values,
            EncodedArray& array) {
  if (options.precision == Digits::single_precision)
    array.encode<float>(snapshot, options.codec, values);
  else
    array.encode<double>(snapshot, options.codec, values);
}

XmlFile::XmlFile(std::string_view type, Codec codec) : type_(type) {
  text_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type_ + "\" version=\"1.0\" byte_order=\"";
  text_ += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  text_ += "\" header_type=\"UInt64\"";
  const std::string_view compressor = compressor_of(codec);
  if (!compressor.empty()) text_.append(" compressor=\"").append(compressor).append("\"");
  text_ += ">\n<" + type_ + ">\n";
}

void XmlFile::add(std::string_view type, std::string_view name, std::string_view attributes,
                  const EncodedArray& array) {
  text_.append("<DataArray type=\"").append(type).append("\" Name=\"").append(name);
  text_.append("\"").append(attributes).append(" format=\"appended\" offset=\"");
  text_ += std::to_string(appended_) + "\"/>\n";
  arrays_.push_back(&array);
  appended_ += array.size();
}

void XmlFile::write(const std::string& path) const {
  AtomicFile file(path);
  file.write(text_ + "</" + type_ + ">\n<AppendedData encoding=\"raw\">\n_");
  for (const EncodedArray* array : arrays_) array->write(file);
  file.write("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

std::string components(std::uint32_t count) {
  return " NumberOfComponents=\"" + std::to_string(count) + "\"";
}

void Collection::add(std::string_view file, double time) {
  entries_ += "<DataSet timestep=\"";
  append_number(entries_, time);
  entries_.append("\" part=\"0\" file=\"").append(file).append("\"/>\n");
}

void Collection::write(const std::string& path) const {
  write_file(
      path,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" +
          entries_ + "</Collection>\n</VTKFile>\n");
}

}  // namespace hyperlattice::vtk
