within HydraulicTestBench.Types;
type Compressibility = Real(
    final quantity="Compressibility", final unit="1/Pa",
    nominal=1e-9) "Compressibility, the reciprocal of a bulk modulus"
  annotation(Documentation(info="<html>
<p>Shares of compressibility add up where bulk moduli do not.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
