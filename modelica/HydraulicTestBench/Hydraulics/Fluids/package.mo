within HydraulicTestBench.Hydraulics;
package Fluids "Oils: stiffness over pressure"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>What fills the slot <code>fluid</code> of a volume or a hose. The default is the thesis' constant stiffness.</p>
<p><b>Source:</b> thesis Eq. 3.4; each class names its own.</p>
</html>"));
end Fluids;
