within HydraulicTestBench.Types;
type NaturalFrequency = Real(
    final quantity="AngularVelocity", final unit="rad/s", displayUnit="Hz",
    min=0, nominal=100) "Natural frequency, undamped"
  annotation(Documentation(info="<html>
<p>The thesis gives it in Hz (Table 4.6); Eq. 3.19 takes rad/s. It is shown in Hz, 28 for 176 rad/s, in an
FMU as well. OMEdit converts rad/s to Hz by 1 (OpenModelica, issue 13298): a number that it calls Hz is rad/s there.</p>
<p><b>Source:</b> thesis; the numbers inside a model are SI units.</p>
</html>"));
