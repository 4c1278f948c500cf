within HydraulicTestBench;
package Validation "Components against closed forms"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Each model carries its closed form and the difference <code>error</code>; the documentation says how large it may
be and
when.</p>
<p><b>Source:</b> the equations of the components, solved by hand.</p>
</html>"));
end Validation;
